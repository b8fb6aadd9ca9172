/** The names of steps, and the toasts about steps that drop work. */
import type { Pair } from '../landmarks.ts';
import {
  clearedSentence,
  count,
  foundSentence,
  pairGone,
  pairsGone,
  pointsGone,
  pointsReplaced,
  SENTENCES,
  takenSentence,
  workGone,
} from '../messages.ts';
import type { RunOptions } from '../report.ts';
import type { Event } from './events.ts';
import type { State, Toast } from './state.ts';
import { workName } from './work.ts';

type Of<K extends Event['kind']> = Extract<Event, { kind: K }>;

/** The name of the step that each kind of event makes, as a command; kinds that make no step have none. */
type Names = { readonly [K in Event['kind']]?: (event: Of<K>, before: State, after: State) => string };

/** A pair by its number, such as "pair 7". */
function called(state: State, id: number): string {
  return `pair ${state.pairs.find((pair) => pair.id === id)?.number ?? ''}`.trim();
}

/** The name of a pick: it names the pair that was added or changed, or both pairs where the mirror image was placed as well. */
function pickName(before: State, after: State): string {
  const numbers = after.pairs.filter((candidate) => !before.pairs.includes(candidate)).map(({ number }) => number);
  const isBegun = after.pairs.length > before.pairs.length;
  const called = `pair${numbers.length > 1 ? 's' : ''} ${numbers.join(' and ')}`;
  return numbers.length === 0 ? 'Place a point' : `${isBegun ? 'Begin' : 'Place'} ${called}`;
}

const OPTION_NAMES: Readonly<Record<keyof RunOptions, string>> = {
  method: 'method',
  base: 'base domain',
  cones: 'cone angles',
  class: 'class',
  ownCones: 'own cones',
  borders: 'rims of holes',
};

const NAMES: Names = {
  mesh: ({ file }) => `Open ${file.name}`,
  mirrored: () => 'Mirror the target',
  'swap-meshes': () => 'Exchange the meshes',
  landmarks: ({ file }) => `Load ${count(file.pairs.length, 'pair')}`,
  'side-marks': ({ name }) => `Load ${name}`,
  'map-opened': ({ map }) => `Open ${map.name}`,
  demo: ({ demo }) => `Open the demo “${demo.title}”`,
  'point-picked': (_, before, after) => pickName(before, after),
  'point-moved': ({ id, side }, before) => {
    const isThere = before.pairs.some((pair) => pair.id === id && pair.points[side] !== null);
    return `${isThere ? 'Move' : 'Place'} ${called(before, id)}`;
  },
  'proposal-accepted': (_, before) => `Take the map’s place for ${called(before, before.proposal?.id ?? 0)}`,
  'pick-dropped': (_, before, after) => {
    const pair = before.pairs.find((candidate) => !after.pairs.includes(candidate));
    return `Give up pair ${pair?.number ?? ''}`.trim();
  },
  'suggestions-taken': (_, before, after) => `Take ${count(after.pairs.length - before.pairs.length, 'suggestion')}`,
  'pair-deleted': ({ id }, before) => `Delete ${called(before, id)}`,
  'pair-labelled': ({ id }, before) => `Rename ${called(before, id)}`,
  'pair-locked': ({ id, locked }, before, after) => {
    const changed = after.pairs.filter((pair) => before.pairs.some((other) => other.id === pair.id && other.locked !== pair.locked)).length;
    return `${locked ? 'Lock' : 'Unlock'} ${changed > 1 ? count(changed, 'pair') : called(before, id)}`;
  },
  'pair-softened': ({ id, radius }, before) => `${radius === null ? 'Hold' : 'Soften'} ${called(before, id)}`,
  'run-done': ({ report }) => `Settle ${count(report.settled?.length ?? 0, 'soft pair')}`,
  'pair-moved': ({ id }, before) => `Reorder ${called(before, id)}`,
  'pairs-cleared': () => 'Delete all pairs',
  'search-done': () => 'Find landmarks',
  'candidate-taken': ({ candidate }) => `Take answer ${candidate + 1} of the search`,
  'targets-exchanged': ({ ids }, before) => `Exchange the targets of ${ids.map((id) => called(before, id)).join(' and ')}`,
  options: ({ options }) => {
    const [key] = Object.keys(options) as (keyof RunOptions)[];
    return `Change the ${key === undefined ? 'options' : OPTION_NAMES[key]}`;
  },
};

function nameOf(event: Event, before: State, after: State): string | null {
  // The table's type ensures that the function under a kind takes events of that kind; the compiler cannot see this for a union.
  const name = NAMES[event.kind] as ((event: Event, before: State, after: State) => string) | undefined;
  return name?.(event, before, after) ?? null;
}

/** The name of the step that these events made together. */
export function stepName(events: readonly Event[], before: State, after: State): string {
  const demo = events.find((event) => event.kind === 'demo');
  const meshes = events.filter((event) => event.kind === 'mesh');
  if (demo === undefined && meshes.length > 1) {
    return `Open ${meshes.map(({ file }) => file.name).join(' and ')}`;
  }
  const named = demo ?? meshes[0] ?? events.findLast((event) => event.kind in NAMES);
  return (named === undefined ? null : nameOf(named, before, after)) ?? 'Change';
}

/** The number of pairs that lost a point or were removed. */
function droppedCount(before: State, after: State): number {
  const pointsOf = ({ points }: Pair): number => points.filter((point) => point !== null).length;
  const later = new Map(after.pairs.map((pair) => [pair.id, pointsOf(pair)]));
  return before.pairs.filter((pair) => pointsOf(pair) > (later.get(pair.id) ?? 0)).length;
}

/** The toast about a step that drops work, with the button that undoes it; `null` where the step drops none. */
export function toastOf(events: readonly Event[], before: State, after: State): Toast | null {
  const undo = true;
  if (events.some(({ kind }) => kind === 'mirrored')) {
    return { sentence: SENTENCES.mirrored, undo };
  }
  if (after.demo !== null && before.demo === null && before.meshes.some((file) => file !== null)) {
    return { sentence: workGone(workName(before.meshes.map((file) => file?.name ?? null)), before.pairs.length), undo };
  }
  const dropped = droppedCount(before, after);
  const kinds = new Set(events.map(({ kind }) => kind));
  if (kinds.has('search-done') || kinds.has('candidate-taken')) {
    const came = after.pairs.filter((pair) => !before.pairs.includes(pair)).length;
    return { sentence: kinds.has('search-done') ? foundSentence(came, dropped) : takenSentence(came, dropped), undo };
  }
  if (dropped === 0 || kinds.has('pick-dropped')) {
    return null;
  }
  if (kinds.has('pair-deleted')) {
    const gone = before.pairs.find(({ id }) => !after.pairs.some((pair) => pair.id === id));
    return { sentence: pairGone(gone?.number ?? 0), undo };
  }
  if (kinds.has('pairs-cleared')) {
    return { sentence: clearedSentence(dropped, after.pairs.length), undo };
  }
  if (kinds.has('side-marks')) {
    return { sentence: pointsReplaced(dropped), undo };
  }
  const stay = new Set(after.pairs.map(({ id }) => id));
  const areHalf = before.pairs.some(({ id }) => stay.has(id));
  return { sentence: areHalf ? pointsGone(dropped) : pairsGone(dropped), undo };
}
