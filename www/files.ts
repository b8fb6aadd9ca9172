/** Tells meshes from landmark files and finds each mesh's side. */
import { failureOf } from './compute/messages.ts';
import type { Failure } from './compute/messages.ts';
import type { LandmarkFile, Pair, Side } from './landmarks.ts';
import { SIDES } from './landmarks.ts';
import { failureSentence, fileSentence, SENTENCES } from './messages.ts';
import type { Event } from './store/events.ts';
import { baseName, landmarkFileOf } from './store/landmark-file.ts';
import { wholePairs } from './store/order.ts';
import { update } from './store/reducer.ts';
import type { MeshFile, State } from './store/state.ts';
import { checkLandmarks, mirrorTarget, readLandmarks, readMesh } from './wasm/conemap.js';

/** Some named bytes. */
export interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** Where a link found them; there is none for a file from a disk. */
  readonly address?: string;
}

/** A reason to refuse files, as a sentence. */
export class FileRefused extends Error {}

function jsonOf(bytes: Uint8Array): unknown {
  const start = bytes.findIndex((byte) => byte > 0x20 && byte !== 0xef && byte !== 0xbb && byte !== 0xbf);
  const first = String.fromCharCode(bytes[start] ?? 0);
  if (first !== '{' && first !== '[') {
    return undefined;
  }
  try {
    return JSON.parse(new TextDecoder().decode(bytes)) as unknown;
  } catch {
    return undefined;
  }
}

function isLandmarkFile(file: NamedBytes): boolean {
  const value = jsonOf(file.bytes);
  const isObject = typeof value === 'object' && value !== null;
  if (isObject && 'pairs' in value) {
    return true;
  }
  if (!file.name.toLowerCase().endsWith('.json')) {
    return false;
  }
  if (isObject && !('asset' in value)) {
    throw new FileRefused(`${file.name}: ${SENTENCES.notLandmarks}`);
  }
  return !isObject;
}

/** Reads and checks a mesh. */
export function meshFile(file: NamedBytes): MeshFile {
  try {
    const mesh = readMesh(file.bytes);
    return {
      name: file.name,
      bytes: file.bytes,
      ...(file.address === undefined ? {} : { address: file.address }),
      mesh,
      vertexCount: mesh.vertexCount,
      faceCount: mesh.faceCount,
      turnedFaces: mesh.turnedFaces,
    };
  } catch (thrown) {
    throw new FileRefused(fileSentence(file.name, failureOf(thrown)));
  }
}

/** Reads a landmark file. */
export function landmarkFile(file: NamedBytes): LandmarkFile {
  try {
    return JSON.parse(readLandmarks(file.bytes)) as LandmarkFile;
  } catch (thrown) {
    throw new FileRefused(fileSentence(file.name, failureOf(thrown)));
  }
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
function misfit(state: State): Failure | null {
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

/** What to say where landmarks that stay do not fit the meshes that come. */
function keptMisfit(events: readonly Event[], state: State): Event[] {
  const failure = misfit(events.reduce(update, state));
  return failure === null ? [] : [{ kind: 'error', sentence: `${failureSentence(failure)} ${SENTENCES.keptMisfit}` }];
}

function sideByName(name: string, file: LandmarkFile | null, state: State): Side | null {
  const names = file === null ? state.named : [file.source, file.target].map((path) => (path === undefined ? null : baseName(path)));
  const isSource = names[0] === name;
  const isTarget = names[1] === name;
  return isSource === isTarget ? null : isSource ? 0 : 1;
}

/** Sides of one or two meshes by the names of the landmark file, the place of the drop, and the order given. */
function sidesOf(meshes: readonly NamedBytes[], landmarks: LandmarkFile | null, over: Side | null, state: State): Side[] {
  const [first, second] = meshes;
  if (first === undefined) {
    return [];
  }
  if (second !== undefined) {
    const swapped =
      sideByName(first.name, landmarks, state) === 1 || sideByName(second.name, landmarks, state) === 0;
    return swapped ? [1, 0] : [0, 1];
  }
  if (over !== null) {
    return [over];
  }
  const named = sideByName(first.name, landmarks, state);
  return [named ?? (state.meshes[0] !== null && state.meshes[1] === null ? 1 : 0)];
}

/** The events that these files mean; all or none. Throws {@link FileRefused}. */
export function eventsOf(files: readonly NamedBytes[], over: Side | null, state: State): Event[] {
  const landmarkFiles = files.filter(isLandmarkFile);
  const meshFiles = files.filter((file) => !landmarkFiles.includes(file));
  if (landmarkFiles.length > 1) {
    throw new FileRefused(SENTENCES.twoLandmarkFiles);
  }
  if (meshFiles.length > 2) {
    throw new FileRefused(SENTENCES.tooManyMeshes);
  }
  const landmarks = landmarkFiles[0] === undefined ? null : landmarkFile(landmarkFiles[0]);
  const sides = sidesOf(meshFiles, landmarks, over, state);
  const loaded: MeshFile[] = [];
  try {
    for (const file of meshFiles) {
      loaded.push(meshFile(file));
    }
    const events: Event[] = loaded.map((file, index) => ({ kind: 'mesh', side: sides[index] ?? 0, file }));
    if (landmarks !== null && landmarkFiles[0] !== undefined) {
      events.push({ kind: 'landmarks', file: landmarks });
      checkFit(landmarkFiles[0], events, state);
      return events;
    }
    return [...events, ...keptMisfit(events, state)];
  } catch (thrown) {
    loaded.forEach((file) => {
      file.mesh.free();
    });
    throw thrown;
  }
}
