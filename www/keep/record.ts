/**
 * A session as it is kept in the browser, version 1: the work, the steps around it, and how it was looked at. Meshes go by the
 * hash of their bytes, which are kept apart, so that a landmark that moves rewrites none. The last map is left out: it is made
 * again from the same work. What later versions add must be optional, or make it version 2.
 *
 * Pairs are in one table, and each step lists its own by their places there: neighbouring steps share nearly all of them, and to
 * check them once is to open quickly. Lists that steps share are shared here, too, and the browser's copy keeps that.
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
/** Longer than any name, label or sentence that is meant for eyes. */
const LONGEST_TEXT = 10_000;
/** More steps than the history holds. */
const MOST_STEPS = 1000;
/** What the meshes of other steps may take beside those on the page, in bytes: on return they are all read at once. */
const MOST_BYTES = 32e6;
/** How long the lists of pairs of all other steps may be together. */
const MOST_LISTED = 100_000;

const Text = v.pipe(v.string(), v.maxLength(LONGEST_TEXT));
/** SHA-256 in base64url. */
const Hash = v.pipe(v.string(), v.regex(/^[\w-]{43}$/));
const MeshRecord = v.object({ name: Text, hash: Hash, address: v.exactOptional(Text), picture: v.exactOptional(Hash) });
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
/** Places in the table of pairs. There are thousands of them, so that each is looked at as quickly as can be. */
const PairList = v.custom<readonly number[]>(
  (value) =>
    Array.isArray(value) && value.length <= MOST_PAIRS && value.every((place: unknown) => Number.isInteger(place) && Number(place) >= 0),
);
const WorkRecord = v.object({
  meshes: v.strictTuple([v.nullable(MeshRecord), v.nullable(MeshRecord)]),
  up: v.strictTuple([Axis, Axis]),
  /** Its id. */
  demo: v.nullable(Text),
  pairs: PairList,
  named: v.strictTuple([v.nullable(Text), v.nullable(Text)]),
  groundTruth: v.nullable(Text),
  options: Options,
});
const Steps = v.pipe(v.array(v.object({ name: Text, work: WorkRecord })), v.maxLength(MOST_STEPS));

/** How a session was looked at; what this page does not know is as at the start. The theme is the browser's, and no session's. */
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
  /** When it was last changed, in ms since 1970. */
  saved: v.pipe(v.number(), v.finite()),
  /** Whether the user began anew when it was offered. */
  declined: v.boolean(),
  /** Of all meshes that it needs. */
  hashes: v.array(Hash),
  /** All pairs of all steps, each as often as it changed. */
  pairs: v.array(PairRecord),
  work: WorkRecord,
  past: Steps,
  future: Steps,
  ui: UiRecord,
});

/** Whether every list has pairs of the table, with an id and a number of their own. */
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

/** What was read from the browser's store. */
export type Reading =
  | { readonly kind: 'session'; readonly record: SessionRecord }
  /** It is of another version of the page, and is left alone. */
  | { readonly kind: 'other-version' }
  | { readonly kind: 'broken' };

/** Checks what was read. */
export function readSession(value: unknown): Reading {
  const parsed = v.safeParse(SessionSchema, value);
  if (parsed.success) {
    return { kind: 'session', record: parsed.output };
  }
  const isOther = v.is(v.object({ version: v.pipe(v.number(), v.integer(), v.notValue(VERSION)) }), value);
  return { kind: isOther ? 'other-version' : 'broken' };
}

/** A session to keep: the work, and as many steps around it as are kept. */
export interface Kept {
  readonly work: Work;
  readonly past: readonly Step[];
  readonly future: readonly Step[];
  /** All meshes of these. */
  readonly files: ReadonlySet<MeshFile>;
}

function filesOf(work: Work): MeshFile[] {
  return work.meshes.filter((file) => file !== null);
}

/** What of a state is kept: the nearest steps, as long as their meshes and lists are not too large. */
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

/** One result for each object. */
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

/** The record of a session. `hashes` has that of each mesh's bytes and of its picture's, where that is a file of its own. */
export function recordOf(
  kept: Kept,
  { id, saved, ui }: { readonly id: string; readonly saved: number; readonly ui: Ui },
  hashes: ReadonlyMap<Uint8Array, string>,
): SessionRecord {
  const mesh = once((file: MeshFile): MeshRecord => ({
    name: file.name,
    hash: hashes.get(file.bytes) ?? '',
    ...(file.address === undefined ? {} : { address: file.address }),
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
    hashes: [...new Set([...kept.files].map(mesh).flatMap(({ hash, picture }) => (picture === undefined ? [hash] : [hash, picture])))],
    // Lists that are checked are not read-only; these are not written to.
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

/** The meshes that a session names, each once. */
export function meshesOf({ work, past, future }: SessionRecord): MeshRecord[] {
  const works = [work, ...past.map((step) => step.work), ...future.map((step) => step.work)];
  const all = works.flatMap(({ meshes }) => meshes.filter((mesh) => mesh !== null));
  return [...new Map(all.map((mesh) => [meshKey(mesh), mesh])).values()];
}

/** Tells meshes of a session apart: the same bytes may have two names, and two pictures. */
export function meshKey({ name, hash, picture }: MeshRecord): string {
  return `${hash} ${picture ?? ''} ${name}`;
}

/** The work and history of a session. `files` has its meshes by key; a demo that is no more is none. */
export function workFrom(
  { pairs, work, past, future }: SessionRecord,
  files: ReadonlyMap<string, MeshFile>,
  demos: readonly Demo[],
): { readonly work: Work; readonly history: History } {
  const file = (mesh: MeshRecord | null): MeshFile | null => (mesh === null ? null : (files.get(meshKey(mesh)) ?? null));
  // Steps that change no mesh share the pair of them, as they do when they are made.
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
