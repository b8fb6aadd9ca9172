/** Turns meshes that were read into files of the page, and checks whether landmarks fit them. */
import { failureOf } from './compute/messages.ts';
import type { Failure } from './compute/messages.ts';
import type { Pair, SurfacePoint } from './landmarks.ts';
import { SIDES } from './landmarks.ts';
import { landmarkFile } from './landmark-files.ts';
import { fileSentence, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import type { MirroredMesh, Question, ReadFile } from './reading/messages.ts';
import type { Event } from './store/events.ts';
import { landmarkFileOf } from './store/landmark-file.ts';
import { wholePairs } from './store/order.ts';
import type { DefectGroup, Examined } from './store/defects.ts';
import { update } from './store/reducer.ts';
import type { MeshFile, State } from './store/state.ts';
import { checkLandmarks, unpackDefects, unpackMesh } from './wasm/page.js';

export type { NamedBytes } from './named-file.ts';
export { FileRefused } from './named-file.ts';
export { landmarkFile } from './landmark-files.ts';

/** A mesh of the page. Throws {@link FileRefused} where it was refused. */
export function meshFile({ file, reading }: ReadFile): MeshFile {
  if (reading.kind === 'bad') {
    throw new FileRefused(reading.sentence, reading);
  }
  const mesh = unpackMesh(reading.packed);
  return {
    name: file.name,
    bytes: file.bytes,
    ...(file.address === undefined ? {} : { address: file.address }),
    ...(file.ofDemo === undefined ? {} : { ofDemo: file.ofDemo }),
    ...(file.picture === undefined ? {} : { picture: file.picture }),
    mesh,
    vertexCount: mesh.vertexCount,
    faceCount: mesh.faceCount,
    turnedFaces: mesh.turnedFaces,
    look: mesh.lookKind(),
    repairs: reading.repairs,
  };
}

/** What was found wrong with a mesh, as the reader has packed it. */
export function examinedOf(packed: Uint8Array): Examined {
  const found = unpackDefects(packed);
  return { found, groups: JSON.parse(found.list()) as DefectGroup[], faceCount: found.faceCount };
}

/** The points that pairs have on the target, each with the index of its pair. */
function markedOnTarget(pairs: readonly Pair[]): (readonly [number, SurfacePoint])[] {
  return pairs.flatMap(({ points: [, point] }, index) => (point === null ? [] : [[index, point] as const]));
}

/** The question to the reading worker for the mirror image of a target, with the points of these pairs on it. */
export function mirrorQuestion(target: MeshFile, pairs: readonly Pair[]): Extract<Question, { kind: 'mirror' }> {
  // The core mirrors the second points of the pairs. Missing first points do not matter, since they are not read.
  const landmarks = new TextEncoder().encode(JSON.stringify({ pairs: markedOnTarget(pairs) }));
  const name = `${target.name.replace(/( \(mirrored\))?\.[^.]*$/, '')} (mirrored).obj`;
  return { kind: 'mirror', mesh: target.mesh.packed(), landmarks, name };
}

/** The event that replaces a target by its mirror image, with the mirrored points of `pairs`, for which the image was asked. */
export function mirroredEvent({ mesh, landmarks }: MirroredMesh, pairs: readonly Pair[]): Event {
  const images = landmarkFile({ name: 'landmarks', bytes: landmarks }).pairs;
  const marked = markedOnTarget(pairs);
  const points = pairs.map((_, index) => images[marked.findIndex(([of]) => of === index)]?.[1] ?? null);
  return { kind: 'mirrored', file: meshFile(mesh), points };
}

/** Why the landmarks of a state are not distinct points of its meshes; `null` where they are. */
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

/** Whether all points of a work, also those of half pairs, are distinct points of its meshes. */
export function areMarksGood({ meshes, pairs }: Pick<State, 'meshes' | 'pairs'>): boolean {
  try {
    for (const side of SIDES) {
      const file = meshes[side];
      const points = pairs.flatMap((pair) => pair.points[side] ?? []);
      if (file !== null && points.length > 0) {
        // The core reads only this side of the pairs.
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
