/** Turns files that were read into events: finds the side of each mesh, and brings landmarks and maps to their meshes. */
import { checkFit, examinedOf, meshFile, misfit } from './files.ts';
import type { LandmarkFile, Side } from './landmarks.ts';
import { otherSide, SIDES } from './landmarks.ts';
import { othersNamed, ownFileRead, pairsRead, sideCalledLike, sideRead } from './landmark-files.ts';
import { checkMeshes, headOf, sideIn } from './map-files.ts';
import { failureSentence, madeForOthers, remarksSentence, repairedSentence, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import type { BadMesh, MeshReading, ReadFile, SortedFile } from './reading/messages.ts';
import type { AwaitedMap } from './store/awaited.ts';
import type { Event } from './store/events.ts';
import { baseName } from './store/landmark-file.ts';
import type { GivenMarks, RefusedMesh } from './store/refused.ts';
import { allowedBy } from './store/refused.ts';
import { update } from './store/reducer.ts';
import type { MeshFile, State } from './store/state.ts';

/** An event by which the page shows a sentence. */
type Said = Extract<Event, { readonly kind: 'error' }>;

/** Several sentences as one event, since the page shows only the last event's; empty for no sentence. */
function together(said: readonly Said[]): Said[] {
  const failure = said.findLast((each) => each.failure !== undefined)?.failure;
  const sentence = said.map((each) => each.sentence).join(' ');
  return said.length === 0 ? [] : [{ kind: 'error', sentence, ...(failure === undefined ? {} : { failure }) }];
}

/** A sentence for landmarks that stay on the page and do not fit the meshes that come; empty where they fit. */
function keptMisfit(events: readonly Event[], state: State): Said[] {
  const failure = misfit(events.reduce(update, state));
  return failure === null ? [] : [{ kind: 'error', sentence: `${failureSentence(failure)} ${SENTENCES.keptMisfit}` }];
}

function sideByName(name: string, file: LandmarkFile | null, state: State): Side | null {
  const names = file === null ? state.named : [file.source, file.target].map((path) => (path === undefined ? null : baseName(path)));
  const isSource = names[0] === name;
  const isTarget = names[1] === name;
  return isSource === isTarget ? null : isSource ? 0 : 1;
}

/** The sides of one or two meshes: by the names in the landmark file, the place of the drop, and the order in which they were given. */
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

/** Landmark files that were given, and the events that they cause. */
interface Landmarks {
  /** The events that bring the landmarks onto the meshes of `names`. */
  readonly events: (names: State['meshes']) => Event[];
  /** The file that is named where its landmarks do not fit. */
  readonly file: NamedBytes;
  /** The pairs of a file by the meshes' own numbers, which may name the meshes; `null` where there is no such file. */
  readonly pairs: LandmarkFile | null;
}

/** The remarks about files that were read, as an event; empty for no remark. */
function told(remarks: readonly string[]): Event[] {
  return remarks.length === 0 ? [] : [{ kind: 'error', sentence: remarksSentence(remarks) }];
}

/** A remark about a file of pairs that names other meshes than those on the page; empty for none. */
function remarkOnNames(file: LandmarkFile, meshes: State['meshes']): string[] {
  const others = othersNamed(file, meshes.map((mesh) => mesh?.name ?? null));
  return others.length === 0 ? [] : [madeForOthers(others)];
}

/** The events for the pairs of files that need both meshes to be read. */
function pairEvents(files: readonly NamedBytes[], [source, target]: State['meshes']): Event[] {
  if (source === null || target === null) {
    throw new FileRefused(`${files[0]?.name ?? ''}: ${SENTENCES.meshesFirst}`);
  }
  const { file, remarks } = pairsRead(files, source.mesh, target.mesh);
  const named = { source: source.name, target: target.name, ...file };
  return [{ kind: 'landmarks', file: named }, ...told(remarks)];
}

/** The events for a file with the points of one mesh: the mesh on which it was dropped, else the one with its name, else the only one. */
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

/** The landmark files that were given, one for both meshes or one for each; `null` for none. */
function landmarksOf(files: readonly GivenMarks[], over: Side | null): Landmarks | null {
  const [first, second] = files;
  if (first === undefined) {
    return null;
  }
  if (second !== undefined) {
    if (files.length > 2 || files.some(({ content }) => content !== 'one')) {
      throw new FileRefused(SENTENCES.twoLandmarkFiles);
    }
    const ordered = (meshes: State['meshes']): NamedBytes[] => {
      const names = meshes.map((mesh) => mesh?.name ?? null);
      const swapped = sideCalledLike(first, names) === 1 || sideCalledLike(second, names) === 0;
      return swapped ? [second, first] : [first, second];
    };
    return { events: (meshes) => pairEvents(ordered(meshes), meshes), file: first, pairs: null };
  }
  if (first.content === 'pairs') {
    const { file: pairs, remarks } = ownFileRead(first);
    return { events: (meshes) => [{ kind: 'landmarks', file: pairs }, ...told([...remarkOnNames(pairs, meshes), ...remarks])], file: first, pairs };
  }
  const isWhole = first.content === 'both';
  const events = (meshes: State['meshes']): Event[] => (isWhole ? pairEvents([first], meshes) : sideEvents(first, over, meshes));
  return { events, file: first, pairs: null };
}

/** The sides on which a map wants one or two meshes; `sides` where the map does not say. */
function sidesWanted(meshes: readonly MeshFile[], sides: readonly Side[], map: AwaitedMap | null): readonly Side[] {
  const [first, second] = meshes;
  if (map === null || first === undefined) {
    return sides;
  }
  const [one, other] = [sideIn(map, first), second === undefined ? null : sideIn(map, second)];
  const side = one ?? (other === null ? null : otherSide(other));
  return side === null ? sides : [side, otherSide(side)];
}

/** What opening files does to the page. */
export interface Opening {
  /** The events, which are dispatched all together. */
  readonly events: readonly Event[];
  /** The map that is opened after them, at once or when its meshes have come; `null` for none. */
  readonly map: AwaitedMap | null;
}

/** Files that were read, by what they hold. */
export interface Arrivals {
  readonly maps: readonly NamedBytes[];
  readonly meshes: readonly ReadFile[];
  readonly landmarks: readonly GivenMarks[];
}

/** The mesh files that are to be read. Throws {@link FileRefused} where there are more files than the page takes at once. */
export function meshesAmong(files: readonly SortedFile[]): readonly SortedFile[] {
  const meshes = files.filter(({ content }) => content === 'mesh');
  if (files.filter(({ content }) => content === 'map').length > 1) {
    throw new FileRefused(SENTENCES.oneMap);
  }
  if (meshes.length > 2) {
    throw new FileRefused(SENTENCES.tooManyMeshes);
  }
  return meshes;
}

/** Sorted files by what they hold; `readings` has the results of reading the meshes among them, in their order. */
export function arrivalsOf(files: readonly SortedFile[], readings: readonly MeshReading[]): Arrivals {
  const meshes = files.filter(({ content }) => content === 'mesh');
  return {
    maps: files.filter(({ content }) => content === 'map'),
    meshes: readings.flatMap((reading, index) => {
      const file = meshes[index];
      if (file === undefined) {
        return [];
      }
      const { name, bytes, picture } = file;
      return [{ file: { name, bytes, ...(picture === undefined ? {} : { picture }) }, reading }];
    }),
    landmarks: files.flatMap(({ name, bytes, content }) => (content === 'mesh' || content === 'map' ? [] : [{ name, bytes, content }])),
  };
}

/**
 * What these files do to the page: a refused mesh leaves the good ones in place; the rest comes whole or not at all. Throws {@link
 * FileRefused}.
 */
export function openingOf({ maps, meshes, landmarks }: Arrivals, over: Side | null, state: State): Opening {
  const [first] = maps;
  const map = first === undefined ? null : headOf(first);
  // A mesh that was dropped on a view goes there, even where a map waits for meshes.
  const wanting = map ?? (over === null ? state.awaited : null);
  const marks = landmarksOf(landmarks, over);
  const sides = sidesOf(meshes.map(({ file }) => file), marks?.pairs ?? null, over, state);
  const read = seated(metMeshes(meshes, sides), wanting);
  return { events: eventsOfRead(read, { landmarkFiles: landmarks, landmarks: marks, map }, state), map };
}

/** The meshes among some files, sorted by whether they were read or refused. */
interface ReadMeshes {
  readonly loaded: readonly { readonly side: Side; readonly file: MeshFile }[];
  /** Refused meshes that can be shown, and that a repair may help. */
  readonly refused: readonly RefusedMesh[];
  /** Why the other meshes were refused. */
  readonly faults: readonly FileRefused[];
  /** Sentences about colours of the good meshes that cannot be used. */
  readonly remarks: readonly string[];
}

/** Frees the core's memory of meshes that do not come onto the page. */
function free({ loaded, refused }: ReadMeshes): void {
  loaded.forEach(({ file }) => {
    file.mesh.free();
  });
  refused.forEach(({ examined }) => {
    examined.found.free();
  });
}

/** A refused mesh with its defects; `null` where the file has no mesh that can be shown. */
function refusedMesh(given: Pick<RefusedMesh, 'side' | 'file' | 'allowed'>, { sentence, offer, defects }: BadMesh): RefusedMesh | null {
  return defects === null ? null : { ...given, offer, sentence, examined: examinedOf(defects) };
}

/** Takes the meshes for their sides one by one, so that a bad one does not stop a good one. */
function metMeshes(meshes: readonly ReadFile[], sides: readonly Side[]): ReadMeshes {
  const [loaded, refused, faults, remarks]: [{ side: Side; file: MeshFile }[], RefusedMesh[], FileRefused[], string[]] = [[], [], [], []];
  const read = { loaded, refused, faults, remarks };
  try {
    meshes.forEach(({ file, reading }, index) => {
      const side = sides[index] ?? 0;
      if (reading.kind === 'good') {
        loaded.push({ side, file: meshFile({ file, reading }) });
        remarks.push(...remarksOn({ file, reading }));
        return;
      }
      const mesh = refusedMesh({ side, file, allowed: {} }, reading);
      if (mesh === null) {
        faults.push(new FileRefused(reading.sentence, reading));
      } else {
        refused.push(mesh);
      }
    });
  } catch (thrown) {
    free(read);
    throw thrown;
  }
  return read;
}

/** Sentences, with the mesh's name, about colours of a mesh that cannot be used. */
function remarksOn({ file, reading }: ReadFile): string[] {
  return reading.kind === 'bad' || reading.remarks.length === 0 ? [] : [`${file.name}: ${remarksSentence(reading.remarks)}`];
}

/** Sentences as one event; empty for none. */
function saidOfLooks(sentences: readonly string[]): Said[] {
  return sentences.length === 0 ? [] : [{ kind: 'error', sentence: sentences.join(' ') }];
}

/** The meshes moved to the sides on which a map wants them, where all were good. */
function seated(read: ReadMeshes, wanting: AwaitedMap | null): ReadMeshes {
  const { loaded, refused, faults } = read;
  if (refused.length + faults.length > 0) {
    return read;
  }
  const given = loaded.map(({ side }) => side);
  const sides = sidesWanted(loaded.map(({ file }) => file), given, wanting);
  return { ...read, loaded: loaded.map(({ file }, index) => ({ side: sides[index] ?? 0, file })) };
}

/** The files that came with meshes. */
interface Companions {
  readonly landmarkFiles: readonly GivenMarks[];
  readonly landmarks: Landmarks | null;
  readonly map: AwaitedMap | null;
}

/** The events of the good meshes that came with bad ones. The landmarks that came with them wait until the refused meshes are repaired. */
function eventsBesideBad(read: ReadMeshes, landmarks: readonly GivenMarks[], state: State): Event[] {
  const meshes = read.loaded.map((mesh): Event => ({ kind: 'mesh', ...mesh }));
  const refused: Event[] = read.refused.length === 0 ? [] : [{ kind: 'refused', refused: { meshes: read.refused, landmarks } }];
  const leftOut = landmarks.length > 0 && read.refused.length === 0 ? ` ${SENTENCES.landmarksLeftOut}` : '';
  const errors = read.faults.map(({ message, failure }): Said => ({ kind: 'error', sentence: `${message}${leftOut}`, ...(failure === null ? {} : { failure }) }));
  const said = [...saidOfLooks(read.remarks), ...(meshes.length === 0 ? [] : keptMisfit(meshes, state)), ...errors];
  return [...meshes, ...refused, ...together(said)];
}

/** The events of meshes together with those of the landmark files; all or none. Throws {@link FileRefused}. */
function withLandmarkFiles(events: readonly Event[], landmarks: Landmarks | null, state: State): Event[] {
  if (landmarks === null) {
    return [...events, ...keptMisfit(events, state)];
  }
  const all = [...events, ...landmarks.events(events.reduce(update, state).meshes)];
  checkFit(landmarks.file, all, state);
  return all;
}

/** The events of meshes whose sides are known, and of a file of pairs for them. Throws {@link FileRefused}. */
export function eventsOfSides(meshes: readonly [ReadFile | null, ReadFile | null], pairs: NamedBytes | null, state: State): Event[] {
  const sides = SIDES.filter((side) => meshes[side] !== null);
  const landmarkFiles = pairs === null ? [] : [{ ...pairs, content: 'pairs' as const }];
  const landmarks = landmarksOf(landmarkFiles, null);
  const read = metMeshes(meshes.filter((mesh) => mesh !== null), sides);
  return eventsOfRead(read, { landmarkFiles, landmarks, map: null }, state);
}

/** Several refusals as one, which carries the first failure of the program among them. */
function allOf(faults: readonly FileRefused[]): FileRefused {
  const failure = faults.find((fault) => fault.failure !== null)?.failure ?? null;
  return new FileRefused(faults.map(({ message }) => message).join(' '), failure === null ? {} : { failure });
}

/** The events of meshes that were read, and of the files that came with them. Throws {@link FileRefused}. */
function eventsOfRead(read: ReadMeshes, { landmarkFiles, landmarks, map }: Companions, state: State): Event[] {
  if (read.faults.length > 0 && read.loaded.length + read.refused.length === 0) {
    throw allOf(read.faults);
  }
  if (read.faults.length + read.refused.length > 0) {
    return eventsBesideBad(read, landmarkFiles, state);
  }
  try {
    const events = read.loaded.map((mesh): Event => ({ kind: 'mesh', ...mesh }));
    if (map !== null) {
      checkMeshes(map, events.reduce(update, state).meshes, state);
    }
    return [...withLandmarkFiles(events, landmarks, state), ...saidOfLooks(read.remarks)];
  } catch (thrown) {
    free(read);
    throw thrown;
  }
}

/** The event of a mesh together with those of the landmark files that waited for it. */
function withWaiting(mesh: Event, side: Side, waiting: readonly GivenMarks[], state: State): Event[] {
  try {
    return withLandmarkFiles([mesh], landmarksOf(waiting, side), state);
  } catch (thrown) {
    if (!(thrown instanceof FileRefused)) {
      throw thrown;
    }
    return [mesh, { kind: 'error', sentence: thrown.message }];
  }
}

/**
 * The events of a refused mesh that was read again with the repair that was offered; after the last such mesh the waiting landmarks come,
 * too.
 */
export function repairedEvents(mesh: RefusedMesh, reading: MeshReading, state: State): Event[] {
  const { side, file } = mesh;
  const others = state.refused?.meshes.filter((other) => other !== mesh) ?? [];
  const waiting = state.refused?.landmarks ?? [];
  if (reading.kind === 'good') {
    const repaired = meshFile({ file, reading });
    const event: Event = { kind: 'mesh', side, file: repaired };
    const sentence = repairedSentence(file.name, repaired.repairs);
    const remarks = saidOfLooks(remarksOn({ file, reading }));
    return [...withWaiting(event, side, others.length === 0 ? waiting : [], state), ...remarks, { kind: 'toast', sentence, undo: true }];
  }
  const next = refusedMesh({ side, file, allowed: allowedBy(mesh) }, reading);
  if (next === null) {
    return [{ kind: 'refused-closed', side }, { kind: 'error', sentence: reading.sentence }];
  }
  return [{ kind: 'refused', refused: { meshes: [...others, next], landmarks: waiting } }];
}
