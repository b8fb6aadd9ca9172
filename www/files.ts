/** Mesh files that are read, and whether landmarks fit their meshes. */
import { failureOf } from './compute/messages.ts';
import type { Failure } from './compute/messages.ts';
import type { Pair } from './landmarks.ts';
import { SIDES } from './landmarks.ts';
import { landmarkFile } from './landmark-files.ts';
import { fileSentence, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import type { Event } from './store/events.ts';
import { landmarkFileOf } from './store/landmark-file.ts';
import { wholePairs } from './store/order.ts';
import type { DefectGroup, Examined } from './store/defects.ts';
import type { Allowed } from './store/refused.ts';
import { update } from './store/reducer.ts';
import type { MeshFile, State } from './store/state.ts';
import type { MeshDefects } from './wasm/conemap.js';
import { checkLandmarks, meshDefects, mirrorTarget, repairedDefects, repairMesh } from './wasm/conemap.js';

export type { NamedBytes } from './named-file.ts';
export { FileRefused } from './named-file.ts';
export { landmarkFile } from './landmark-files.ts';

/** Reads a mesh, and repairs what does not change its shape and what is allowed beyond. Throws {@link FileRefused}. */
export function meshFile(file: NamedBytes, allowed: Allowed = {}): MeshFile {
  try {
    const report = repairMesh(file.bytes, JSON.stringify(allowed));
    const mesh = report.mesh();
    const repairs = report.sentence();
    report.free();
    return {
      name: file.name,
      bytes: file.bytes,
      ...(file.address === undefined ? {} : { address: file.address }),
      mesh,
      vertexCount: mesh.vertexCount,
      faceCount: mesh.faceCount,
      turnedFaces: mesh.turnedFaces,
      repairs,
    };
  } catch (thrown) {
    const failure = failureOf(thrown);
    throw new FileRefused(fileSentence(file.name, failure), failure.offer ?? null, failure.code === 'mesh' ? 'mesh' : 'file');
  }
}

function examinedOf(found: MeshDefects): Examined {
  return { found, groups: JSON.parse(found.list()) as DefectGroup[], faceCount: found.faceCount };
}

/** What is wrong with a mesh that was refused; `null` where there is nothing to be seen of it. */
export function examinedMesh(file: NamedBytes, allowed: Allowed): Examined | null {
  try {
    return examinedOf(meshDefects(file.bytes, JSON.stringify(allowed)));
  } catch (thrown) {
    if (failureOf(thrown).code === 'mesh') {
      return null;
    }
    throw thrown;
  }
}

/** What was wrong with a mesh that was repaired. */
export function examinedRepair({ bytes, mesh }: MeshFile): Examined {
  return examinedOf(repairedDefects(bytes, mesh));
}

/** The event that puts a target's mirror image in its place, with the points of these pairs on it. */
export function mirroredTarget(target: MeshFile, pairs: readonly Pair[]): Event {
  // The core mirrors the second points of a file; the first ones may be missing, and are not looked at.
  const marked = pairs.flatMap(({ points: [, point] }, index) => (point === null ? [] : [[index, point] as const]));
  const mirrored = mirrorTarget(target.mesh, new TextEncoder().encode(JSON.stringify({ pairs: marked })));
  const name = `${target.name.replace(/( \(mirrored\))?\.[^.]*$/, '')} (mirrored).obj`;
  const file = meshFile({ name, bytes: mirrored.mesh() });
  const images = landmarkFile({ name: 'landmarks', bytes: mirrored.landmarks() }).pairs;
  mirrored.free();
  const points = pairs.map((_, index) => images[marked.findIndex(([of]) => of === index)]?.[1] ?? null);
  return { kind: 'mirrored', file, points };
}

/** Why the landmarks of a state are no different points of its meshes; `null` where they are. */
export function misfit(state: State): Failure | null {
  if (wholePairs(state).length === 0) {
    return null;
  }
  const landmarks = new TextEncoder().encode(JSON.stringify(landmarkFileOf(state)));
  try {
    for (const side of SIDES) {
      const file = state.meshes[side];
      if (file !== null) {
        checkLandmarks(file.mesh, side, landmarks);
      }
    }
    return null;
  } catch (thrown) {
    return failureOf(thrown);
  }
}

/** Whether all points of a work, those of half pairs too, are different points of its meshes. */
export function areMarksGood({ meshes, pairs }: Pick<State, 'meshes' | 'pairs'>): boolean {
  try {
    for (const side of SIDES) {
      const file = meshes[side];
      const points = pairs.flatMap((pair) => pair.points[side] ?? []);
      if (file !== null && points.length > 0) {
        // Only one side of the file is looked at.
        const landmarks = { pairs: points.map((point) => [point, point]) };
        checkLandmarks(file.mesh, side, new TextEncoder().encode(JSON.stringify(landmarks)));
      }
    }
    return true;
  } catch (thrown) {
    if (thrown instanceof WebAssembly.RuntimeError) {
      throw thrown;
    }
    return false;
  }
}

/** Refuses landmarks that do not fit the meshes they would be shown on. Throws {@link FileRefused}. */
export function checkFit(file: Pick<NamedBytes, 'name'>, events: readonly Event[], state: State): void {
  const failure = misfit(events.reduce(update, state));
  if (failure !== null) {
    const advice = failure.code === 'other-meshes' ? ` ${SENTENCES.otherMeshes}` : '';
    throw new FileRefused(`${fileSentence(file.name, failure)}${advice}`);
  }
}
