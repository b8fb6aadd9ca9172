/** Whether the last map belongs to what is on the page, and what has changed since it was made. */
import { isSamePoint, SIDES } from '../landmarks.ts';
import type { Pair, Side } from '../landmarks.ts';
import type { RunOptions } from '../report.ts';
import { wholePairs } from './order.ts';
import type { Result, State } from './state.ts';
import type { Work } from './work.ts';

/**
 * The differences from the inputs of a map. Labels, locks, the order of the pairs and half pairs do not count, since they do not change the
 * map.
 */
export interface Changes {
  /** Sides with another mesh. */
  readonly meshes: readonly Side[];
  /** Numbers of the pairs that were added. */
  readonly placed: readonly number[];
  /** Numbers of the pairs that were moved. */
  readonly moved: readonly number[];
  /** Numbers of the pairs that were made soft or held, or whose radius has changed. */
  readonly softened: readonly number[];
  /** Numbers of the pairs that were removed. */
  readonly removed: readonly number[];
  readonly options: readonly (keyof RunOptions)[];
}

function isMoved(before: Pair, after: Pair): boolean {
  return SIDES.some((side) => !isSamePoint(before.points[side], after.points[side]));
}

/** The changes from one work to another; `null` where both give the same map. */
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

/** The changes since the last map was made; `null` where it is up to date or there is none. */
export function staleness(state: State): Changes | null {
  return state.result === null ? null : changesBetween(state.result.inputs, state);
}

/** Whether there is a map that is up to date. */
export function isCurrent(state: State): boolean {
  return state.result !== null && staleness(state) === null;
}

/** The last map where it is one of the meshes on the page, up to date or not: the map that views can show. Otherwise `null`. */
export function shownResult({ result, meshes }: Pick<State, 'result' | 'meshes'>): Result | null {
  const isTheirs = result !== null && SIDES.every((side) => result.inputs.meshes[side] === meshes[side]);
  return isTheirs ? result : null;
}

/** Whether the meshes on the page were brought back without their map, and have none since. */
export function isMapless({ mapless, meshes }: Pick<State, 'mapless' | 'meshes'>): boolean {
  return mapless !== null && SIDES.every((side) => mapless[side] === meshes[side]);
}

/** Whether the pairs of the last map are still where they were; others may have been added. */
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
