/** Whether the last map belongs to what is on the page, and what has changed since it was made. */
import { isSamePoint, SIDES } from '../landmarks.ts';
import type { Pair, Side } from '../landmarks.ts';
import type { RunOptions } from '../report.ts';
import { wholePairs } from './order.ts';
import type { Result, State } from './state.ts';
import type { Work } from './work.ts';

/** What differs from the inputs of a map. Labels, locks, the order of the pairs and half pairs make no other map. */
export interface Changes {
  /** Sides with another mesh. */
  readonly meshes: readonly Side[];
  /** Numbers of pairs that came. */
  readonly placed: readonly number[];
  /** Numbers of pairs that moved. */
  readonly moved: readonly number[];
  /** Numbers of pairs that became soft, held or have another radius. */
  readonly softened: readonly number[];
  /** Numbers of pairs that went. */
  readonly removed: readonly number[];
  readonly options: readonly (keyof RunOptions)[];
}

function isMoved(before: Pair, after: Pair): boolean {
  return SIDES.some((side) => !isSamePoint(before.points[side], after.points[side]));
}

/** What has changed from one work to another; `null` where both give the same map. */
export function changesBetween(before: Work, after: Work): Changes | null {
  const [old, present] = [wholePairs(before), wholePairs(after)];
  const oldById = new Map(old.map((pair) => [pair.id, pair]));
  const ids = new Set(present.map(({ id }) => id));
  const numbers = (pairs: readonly Pair[]): number[] => pairs.map(({ number }) => number);
  const differing = (differ: (before: Pair, after: Pair) => boolean): number[] =>
    numbers(
      present.filter((pair) => {
        const earlier = oldById.get(pair.id);
        return earlier !== undefined && differ(earlier, pair);
      }),
    );
  const changes: Changes = {
    meshes: SIDES.filter((side) => before.meshes[side] !== after.meshes[side]),
    placed: numbers(present.filter(({ id }) => !oldById.has(id))),
    moved: differing(isMoved),
    softened: differing((earlier, pair) => earlier.radius !== pair.radius),
    removed: numbers(old.filter(({ id }) => !ids.has(id))),
    options: (Object.keys(after.options) as (keyof RunOptions)[]).filter((key) => before.options[key] !== after.options[key]),
  };
  return Object.values(changes).every((list: readonly unknown[]) => list.length === 0) ? null : changes;
}

/** What has changed since the last map was made; `null` where it is current or there is none. */
export function staleness(state: State): Changes | null {
  return state.result === null ? null : changesBetween(state.result.inputs, state);
}

/** Whether there is a map that belongs to what is on the page. */
export function isCurrent(state: State): boolean {
  return state.result !== null && staleness(state) === null;
}

/** The last map where it is one of the meshes on the page, current or not: what views can show. */
export function shownResult({ result, meshes }: Pick<State, 'result' | 'meshes'>): Result | null {
  const isTheirs = result !== null && SIDES.every((side) => result.inputs.meshes[side] === meshes[side]);
  return isTheirs ? result : null;
}

/** Whether the pairs of the last map are where they were; more may have come. */
export function hasItsCones(state: State): boolean {
  const { result, pairs } = state;
  return (
    result !== null &&
    wholePairs(result.inputs).every((before) => {
      const after = pairs.find(({ id }) => id === before.id);
      return after !== undefined && !isMoved(before, after);
    })
  );
}
