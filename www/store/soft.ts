/** Soft pairs: the run may move their points on the target, within a radius, to where the map around them leads. */
import type { Pair } from '../landmarks.ts';
import { MAX_RADIUS } from '../landmarks.ts';
import { settledSentence } from '../messages.ts';
import type { SettledLandmark } from '../report.ts';
import { wholePairs } from './order.ts';
import { pairOf, replaced, withPoint } from './pairs.ts';
import type { State } from './state.ts';
import type { Work } from './work.ts';

/** A pair that is held: one without a radius. */
function held({ id, number, points, label, locked }: Pair): Pair {
  return { id, number, points, label, locked };
}

/** Makes a pair soft, changes its radius, or holds it again (`null`). */
export function withRadius(state: State, id: number, radius: number | null): State {
  const pair = pairOf(state, id);
  if (pair === null || (pair.radius ?? null) === radius || !(radius === null || (radius > 0 && radius <= MAX_RADIUS))) {
    return state;
  }
  return { ...state, pairs: replaced(state.pairs, radius === null ? held(pair) : { ...pair, radius }) };
}

/** For each soft pair of a run's work that has settled, the same pair at the point where it settled, held there from now on. */
function settledPairs(inputs: Work, settled: readonly SettledLandmark[]): ReadonlyMap<Pair, Pair> {
  const whole = wholePairs(inputs);
  return new Map(
    settled.flatMap(({ pair: order, point }) => {
      const pair = whole[order];
      return pair === undefined ? [] : [[pair, held({ ...pair, points: withPoint(pair.points, 1, point) })] as const];
    }),
  );
}

/** The run's inputs and the page after soft landmarks have settled; a pair on the page that has changed since stays as it is. */
export function withSettled(state: State, inputs: Work, settled: readonly SettledLandmark[]): { readonly state: State; readonly inputs: Work } {
  if (settled.length === 0) {
    return { state, inputs };
  }
  const pairs = settledPairs(inputs, settled);
  const swapped = (list: readonly Pair[]): readonly Pair[] => list.map((pair) => pairs.get(pair) ?? pair);
  const farthest = settled.reduce((most, { moved }) => Math.max(most, moved), 0);
  const toast = { sentence: settledSentence(settled.length, farthest), undo: true };
  return {
    state: { ...state, pairs: swapped(state.pairs), toast },
    inputs: { ...inputs, pairs: swapped(inputs.pairs) },
  };
}
