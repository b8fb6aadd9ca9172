/**
 * A session as the browser keeps it, version 1: the work, the steps before and after it, and how it was viewed. A mesh is named by the
 * hash of its bytes, which are stored apart, so that moving a landmark does not write a mesh again. The last map is not kept, only that there
 * was one: it can be made again from the same work. Fields that later versions add must be optional, or else the version becomes 2.
 *
 * Pairs are in one table, and each step lists the indices of its pairs there: neighbouring steps share nearly all of their pairs, and a
 * session opens quickly when each pair is checked only once. Steps that share a list share it here, too, and the browser keeps it so.
 */
import * as v from 'valibot';
import type { Pair } from '../landmarks.ts';
import { Axis, Cameras, Index, MOST_PAIRS, Options, Radius, StyleSchema, Weight } from '../send/schema.ts';
import type { History, Step } from '../store/history.ts';
import type { State, Ui } from '../store/state.ts';
import { INITIAL } from '../store/state.ts';
import type { Demo, MeshFile, Work } from '../store/work.ts';
import { workOf } from '../store/work.ts';
import { wordsOf } from '../unions.ts';

const VERSION = 1;
/** The most characters of a text, more than any name, label or sentence has. */
const LONGEST_TEXT = 10_000;
/** The most steps of a record, more than the history holds. */
const MOST_STEPS = 1000;
/** The most bytes of meshes of other steps, beside those on the page: all of them are read when the work is brought back. */
const MOST_BYTES = 32e6;
/** The most entries in the lists of pairs of all other steps together. */
const MOST_LISTED = 100_000;

const Text = v.pipe(v.string(), v.maxLength(LONGEST_TEXT));
/** A SHA-256 hash in base64url. */
const Hash = v.pipe(v.string(), v.regex(/^[\w-]{43}$/));
const MeshRecord = v.object({
  name: Text,
  hash: Hash,
  address: v.exactOptional(Text),
  picture: v.exactOptional(Hash),
  ofDemo: v.exactOptional(v.object({ id: Text, side: v.picklist([0, 1]) })),
});
const Point = v.nullable(v.union([Index, v.object({ face: Index, barycentric: v.strictTuple([Weight, Weight, Weight]) })]));
const PairRecord = v.object({
  id: v.pipe(Index, v.minValue(1)),
  number: v.pipe(Index, v.minValue(1)),
  points: v.pipe(
    v.strictTuple([Point, Point]),
    v.check(([source, target]) => source !== null || target !== null),
  ),
  label: Text,
  locked: v.boolean(),
  radius: v.exactOptional(Radius),
});
/** Indices into the table of pairs. There are thousands of lists, so each is checked as quickly as possible. */
const PairList = v.custom<readonly number[]>(
  (value) =>
    Array.isArray(value) && value.length <= MOST_PAIRS && value.every((place: unknown) => Number.isInteger(place) && Number(place) >= 0),
);
const WorkRecord = v.object({
  meshes: v.strictTuple([v.nullable(MeshRecord), v.nullable(MeshRecord)]),
  up: v.strictTuple([Axis, Axis]),
  /** The id of the demo. */
  demo: v.nullable(Text),
  pairs: PairList,
  named: v.strictTuple([v.nullable(Text), v.nullable(Text)]),
  groundTruth: v.nullable(Text),
  options: Options,
});
const Steps = v.pipe(v.array(v.object({ name: Text, work: WorkRecord })), v.maxLength(MOST_STEPS));

/**
 * How a session was viewed; a field whose value this page does not know gets its initial value. The theme belongs to the browser, not to
 * the session.
 */
const UiRecord = v.object({
  step: v.fallback(v.picklist(wordsOf<Ui['step']>({ meshes: true, landmarks: true, map: true, use: true, method: true })), INITIAL.ui.step),
  panel: v.fallback(v.picklist(wordsOf<Ui['panel']>({ open: true, folded: true })), INITIAL.ui.panel),
  link: v.fallback(v.picklist(wordsOf<Ui['link']>({ free: true, linked: true, map: true })), INITIAL.ui.link),
  cameras: v.fallback(Cameras, [null, null]),
  style: v.fallback(StyleSchema, INITIAL.ui.style),
});

const Session = v.object({
  version: v.literal(VERSION),
  id: Text,
  /** When the session was last changed, in ms since 1970. */
  saved: v.pipe(v.number(), v.finite()),
  /** Whether the user began anew when the session was offered. */
  declined: v.boolean(),
  /** Whether there was a map of the meshes. */
  hadMap: v.exactOptional(v.boolean()),
  /** The hashes of all meshes that the session needs. */
  hashes: v.array(Hash),
  /** The pairs of all steps: each pair once for every change of it. */
  pairs: v.array(PairRecord),
  work: WorkRecord,
  past: Steps,
  future: Steps,
  ui: UiRecord,
});

/** Whether every list refers to pairs of the table, and no two pairs of a list have the same id or number. */
function areListsSound({ pairs, work, past, future }: v.InferOutput<typeof Session>): boolean {
  const lists = new Set([work, ...past.map((step) => step.work), ...future.map((step) => step.work)].map((each) => each.pairs));
  return [...lists].every((list) => {
    const listed = list.map((place) => pairs[place]);
    const [ids, numbers] = [new Set(listed.map((pair) => pair?.id)), new Set(listed.map((pair) => pair?.number))];
    return ids.size === list.length && numbers.size === list.length && !ids.has(undefined);
  });
}

const SessionSchema = v.pipe(Session, v.check(areListsSound));

export type MeshRecord = v.InferOutput<typeof MeshRecord>;
type WorkRecord = v.InferOutput<typeof WorkRecord>;
export type SessionRecord = v.InferOutput<typeof SessionSchema>;

/** The result of reading a record of the browser's store. */
export type Reading =
  | { readonly kind: 'session'; readonly record: SessionRecord }
  /** The record is of another version of the page, and is left alone. */
  | { readonly kind: 'other-version' }
  | { readonly kind: 'broken' };

/** Checks a record that was read. */
export function readSession(value: unknown): Reading {
  const parsed = v.safeParse(SessionSchema, value);
  if (parsed.success) {
    return { kind: 'session', record: parsed.output };
  }
  const isOther = v.is(v.object({ version: v.pipe(v.number(), v.integer(), v.notValue(VERSION)) }), value);
  return { kind: isOther ? 'other-version' : 'broken' };
}

/** What is written of a session: the work, and as many steps around it as are kept. */
export interface Kept {
  readonly work: Work;
  readonly past: readonly Step[];
  readonly future: readonly Step[];
  /** All meshes of the work and the steps. */
  readonly files: ReadonlySet<MeshFile>;
}

function filesOf(work: Work): MeshFile[] {
  return work.meshes.filter((file) => file !== null);
}

/** The part of a state that is kept: the work and the nearest steps, as long as their meshes and lists are not too large. */
export function keptOf(state: State): Kept {
  const work = workOf(state);
  const files = new Set(filesOf(work));
  const lists = new Set([work.pairs]);
  let [bytes, listed] = [0, 0];
  const nearest = (steps: readonly Step[]): readonly Step[] => {
    let first = steps.length;
    while (first > 0) {
      const next = steps[first - 1]?.work ?? work;
      const more = filesOf(next).filter((file) => !files.has(file));
      bytes += more.reduce((sum, file) => sum + file.bytes.byteLength, 0);
      listed += lists.has(next.pairs) ? 0 : next.pairs.length;
      if (bytes > MOST_BYTES || listed > MOST_LISTED) {
        break;
      }
      more.forEach((file) => files.add(file));
      lists.add(next.pairs);
      first--;
    }
    return steps.slice(first);
  };
  const [past, future] = [nearest(state.history.past), nearest(state.history.future)];
  return { work, past, future, files };
}

/** A version of `make` that makes one result for each object and returns it again. */
function once<K extends object, T>(make: (key: K) => T): (key: K) => T {
  const made = new Map<K, T>();
  return (key) => {
    const known = made.get(key);
    if (known !== undefined) {
      return known;
    }
    const value = make(key);
    made.set(key, value);
    return value;
  };
}

/** The record of a session. `hashes` has the hash of each mesh's bytes, and of its picture's where that is a separate file. */
export function recordOf(
  kept: Kept,
  { id, saved, ui, hadMap }: { readonly id: string; readonly saved: number; readonly ui: Ui; readonly hadMap: boolean },
  hashes: ReadonlyMap<Uint8Array, string>,
): SessionRecord {
  const mesh = once((file: MeshFile): MeshRecord => ({
    name: file.name,
    hash: hashes.get(file.bytes) ?? '',
    ...(file.address === undefined ? {} : { address: file.address }),
    ...(file.ofDemo === undefined ? {} : { ofDemo: file.ofDemo }),
    ...(file.picture === undefined ? {} : { picture: hashes.get(file.picture) ?? '' }),
  }));
  const table: Pair[] = [];
  const place = once((pair: Pair) => table.push(pair) - 1);
  const places = once((list: readonly Pair[]) => list.map(place));
  const record = ({ meshes: [source, target], up, demo, pairs: list, named, groundTruth, options }: Work): WorkRecord => ({
    meshes: [source === null ? null : mesh(source), target === null ? null : mesh(target)],
    up: [...up],
    demo: demo?.id ?? null,
    pairs: places(list),
    named: [...named],
    groundTruth,
    options,
  });
  const steps = (list: readonly Step[]): SessionRecord['past'] => list.map(({ name, work }) => ({ name, work: record(work) }));
  const [work, past, future] = [record(kept.work), steps(kept.past), steps(kept.future)];
  return {
    version: VERSION,
    id,
    saved,
    declined: false,
    hadMap,
    hashes: [...new Set([...kept.files].map(mesh).flatMap(({ hash, picture }) => (picture === undefined ? [hash] : [hash, picture])))],
    // The lists of the schema's type are not read-only; these lists are never written to.
    pairs: table as SessionRecord['pairs'],
    work,
    past,
    future,
    ui: {
      step: ui.step,
      panel: ui.panel,
      link: ui.link,
      cameras: ui.cameras as SessionRecord['ui']['cameras'],
      style: ui.style,
    },
  };
}

/** The meshes that a session names, each listed once. */
export function meshesOf({ work, past, future }: SessionRecord): MeshRecord[] {
  const works = [work, ...past.map((step) => step.work), ...future.map((step) => step.work)];
  const all = works.flatMap(({ meshes }) => meshes.filter((mesh) => mesh !== null));
  return [...new Map(all.map((mesh) => [meshKey(mesh), mesh])).values()];
}

/** The key of a mesh in a session: the same bytes may have two names, and two pictures. */
export function meshKey({ name, hash, picture }: MeshRecord): string {
  return `${hash} ${picture ?? ''} ${name}`;
}

/** The work and history of a session. `files` has its meshes by key. A demo that no longer exists is left out. */
export function workFrom(
  { pairs, work, past, future }: SessionRecord,
  files: ReadonlyMap<string, MeshFile>,
  demos: readonly Demo[],
): { readonly work: Work; readonly history: History } {
  const file = (mesh: MeshRecord | null): MeshFile | null => (mesh === null ? null : (files.get(meshKey(mesh)) ?? null));
  // Steps that change no mesh share the array of both meshes, as they do when they are made.
  const both = new Map<string, Work['meshes']>();
  const listed = once((places: readonly number[]): readonly Pair[] => places.flatMap((place) => pairs[place] ?? []));
  const made = (record: WorkRecord): Work => {
    const [source, target] = record.meshes;
    const key = JSON.stringify([source, target]);
    const meshes = both.get(key) ?? ([file(source), file(target)] as const);
    both.set(key, meshes);
    return { ...record, meshes, pairs: listed(record.pairs), demo: demos.find(({ id }) => id === record.demo) ?? null };
  };
  const steps = (list: SessionRecord['past']): Step[] => list.map((step) => ({ name: step.name, work: made(step.work) }));
  return { work: made(work), history: { past: steps(past), future: steps(future), gesture: null } };
}
