/** Tells meshes from landmark files and finds each mesh's side. */
import { failureOf } from './compute/messages.ts';
import type { Failure } from './compute/messages.ts';
import type { LandmarkFile, Pair, Side } from './landmarks.ts';
import { otherSide, SIDES } from './landmarks.ts';
import { contentOf, landmarkFile, pairsRead, sideCalledLike, sideRead } from './landmark-files.ts';
import type { LandmarkContent } from './landmark-files.ts';
import { checkMeshes, headOf, mapsAmong, sideIn } from './map-files.ts';
import { gathered } from './mesh-sets.ts';
import { failureSentence, fileSentence, remarksSentence, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import type { AwaitedMap } from './store/awaited.ts';
import type { Event } from './store/events.ts';
import { baseName, landmarkFileOf } from './store/landmark-file.ts';
import { wholePairs } from './store/order.ts';
import { update } from './store/reducer.ts';
import type { MeshFile, State } from './store/state.ts';
import { checkLandmarks, mirrorTarget, repairMesh } from './wasm/conemap.js';

export type { NamedBytes } from './named-file.ts';
export { FileRefused } from './named-file.ts';
export { landmarkFile } from './landmark-files.ts';

/** Reads a mesh and repairs what does not change its shape. */
export function meshFile(file: NamedBytes): MeshFile {
  try {
    const report = repairMesh(file.bytes);
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

/** The landmark files among some, and what they mean. */
interface Landmarks {
  /** What comes onto the meshes, which are those that it is given. */
  readonly events: (names: State['meshes']) => Event[];
  /** The file to name where its landmarks do not fit. */
  readonly file: NamedBytes;
  /** The pairs of a file in the meshes' own numbers, which may name the meshes. */
  readonly pairs: LandmarkFile | null;
}

/** Sentences about what was read, as an event. */
function told(remarks: readonly string[]): Event[] {
  return remarks.length === 0 ? [] : [{ kind: 'error', sentence: remarksSentence(remarks) }];
}

/** The pairs of files that need both meshes. */
function pairEvents(files: readonly NamedBytes[], [source, target]: State['meshes']): Event[] {
  if (source === null || target === null) {
    throw new FileRefused(`${files[0]?.name ?? ''}: ${SENTENCES.meshesFirst}`);
  }
  const { file, remarks } = pairsRead(files, source.mesh, target.mesh);
  const named = { source: source.name, target: target.name, ...file };
  return [{ kind: 'landmarks', file: named }, ...told(remarks)];
}

/** The points of a file for one mesh: the one it was dropped on, that is called like it, or that is alone. */
function sideEvents(file: NamedBytes, over: Side | null, meshes: State['meshes']): Event[] {
  const names = meshes.map((mesh) => mesh?.name ?? null);
  const there = SIDES.filter((side) => meshes[side] !== null);
  const side = over ?? sideCalledLike(file, names) ?? (there.length === 1 ? there[0] : null) ?? null;
  if (side === null && there.length > 0) {
    throw new FileRefused(`${file.name}: ${SENTENCES.whichMesh}`);
  }
  const mesh = side === null ? null : meshes[side];
  if (side === null || mesh === null) {
    throw new FileRefused(`${file.name}: ${SENTENCES.meshesFirst}`);
  }
  const { marks, remarks } = sideRead(file, mesh.mesh, side);
  const points = marks.flatMap(({ label, point }) => (point === null ? [] : [{ label, point }]));
  return [{ kind: 'side-marks', side, points, name: file.name }, ...told(remarks)];
}

/** The landmark files that were given, one or one for each mesh; `null` for none. */
function landmarksOf(files: readonly NamedBytes[], contents: readonly LandmarkContent[], over: Side | null): Landmarks | null {
  const [first, second] = files;
  if (first === undefined) {
    return null;
  }
  if (second !== undefined) {
    if (files.length > 2 || contents.some((content) => content !== 'one')) {
      throw new FileRefused(SENTENCES.twoLandmarkFiles);
    }
    const ordered = (meshes: State['meshes']): NamedBytes[] => {
      const names = meshes.map((mesh) => mesh?.name ?? null);
      const swapped = sideCalledLike(first, names) === 1 || sideCalledLike(second, names) === 0;
      return swapped ? [second, first] : [first, second];
    };
    return { events: (meshes) => pairEvents(ordered(meshes), meshes), file: first, pairs: null };
  }
  if (contents[0] === 'pairs') {
    const pairs = landmarkFile(first);
    return { events: () => [{ kind: 'landmarks', file: pairs }], file: first, pairs };
  }
  const isWhole = contents[0] === 'both';
  const events = (meshes: State['meshes']): Event[] => (isWhole ? pairEvents([first], meshes) : sideEvents(first, over, meshes));
  return { events, file: first, pairs: null };
}

/** The sides of one or two meshes that a map wants; `sides` where it does not tell. */
function sidesWanted(meshes: readonly MeshFile[], sides: readonly Side[], map: AwaitedMap | null): readonly Side[] {
  const [first, second] = meshes;
  if (map === null || first === undefined) {
    return sides;
  }
  const [one, other] = [sideIn(map, first), second === undefined ? null : sideIn(map, second)];
  const side = one ?? (other === null ? null : otherSide(other));
  return side === null ? sides : [side, otherSide(side)];
}

/** What files mean. */
export interface Opening {
  /** All or none. */
  readonly events: readonly Event[];
  /** To be opened after them, now or when its meshes have come. */
  readonly map: AwaitedMap | null;
}

/** What these files mean. Throws {@link FileRefused}. */
export function openingOf(given: readonly NamedBytes[], over: Side | null, state: State): Opening {
  const { maps, others } = mapsAmong(gathered(given));
  const [first] = maps;
  if (maps.length > 1) {
    throw new FileRefused(SENTENCES.oneMap);
  }
  const map = first === undefined ? null : headOf(first);
  // A mesh that was put on a view goes there, whatever waits for it.
  const wanting = map ?? (over === null ? state.awaited : null);
  return { events: eventsOf(others, over, state, { map, wanting }), map };
}

/** The events of meshes and landmark files. `map` comes with them, and `wanting` tells the sides of its meshes. */
function eventsOf(
  given: readonly NamedBytes[],
  over: Side | null,
  state: State,
  { map, wanting }: { readonly map: AwaitedMap | null; readonly wanting: AwaitedMap | null },
): Event[] {
  const files = given.map((file) => ({ file, content: contentOf(file) }));
  const meshFiles = files.flatMap(({ file, content }) => (content === null ? [file] : []));
  const marked = files.flatMap(({ file, content }) => (content === null ? [] : [{ file, content }]));
  if (meshFiles.length > 2) {
    throw new FileRefused(SENTENCES.tooManyMeshes);
  }
  const landmarks = landmarksOf(marked.map(({ file }) => file), marked.map(({ content }) => content), over);
  const loaded: MeshFile[] = [];
  try {
    for (const file of meshFiles) {
      loaded.push(meshFile(file));
    }
    const sides = sidesWanted(loaded, sidesOf(meshFiles, landmarks?.pairs ?? null, over, state), wanting);
    const events: Event[] = loaded.map((file, index) => ({ kind: 'mesh', side: sides[index] ?? 0, file }));
    if (map !== null) {
      checkMeshes(map, events.reduce(update, state).meshes, state);
    }
    if (landmarks === null) {
      return [...events, ...keptMisfit(events, state)];
    }
    events.push(...landmarks.events(events.reduce(update, state).meshes));
    checkFit(landmarks.file, events, state);
    return events;
  } catch (thrown) {
    loaded.forEach((file) => {
      file.mesh.free();
    });
    throw thrown;
  }
}
