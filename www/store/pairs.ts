/** Changes of the landmark pairs: picks, points that wait for their partner, suggestions, undo. */
import type { Pair, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import { pointTaken } from '../messages.ts';
import type { State } from './state.ts';

/** More steps than anybody takes back; it bounds the memory of a page that stays open for days. */
const MAX_HISTORY = 200;

/** Other pairs; the present ones can be had back. */
export function withPairs(state: State, pairs: readonly Pair[]): State {
  return { ...state, pairs, findings: [], history: [...state.history, state.pairs].slice(-MAX_HISTORY) };
}

/** The suggestions of one side replaced. */
export function withSuggestions(state: State, side: Side, suggestions: readonly Suggestion[]): State['suggestions'] {
  return side === 0 ? [suggestions, state.suggestions[1]] : [state.suggestions[0], suggestions];
}

/** A point of one side is picked: half a pair, or the other half of one. */
export function withPick(state: State, side: Side, point: SurfacePoint): State {
  const { pending } = state;
  const isSame = (other: SurfacePoint): boolean => JSON.stringify(other) === JSON.stringify(point);
  const pair = state.pairs.findIndex(({ points }) => isSame(points[side]));
  if (pair >= 0) {
    return { ...state, error: pointTaken(side, pair + 1) };
  }
  const left = state.suggestions[side].filter((suggestion) => suggestion.point !== point);
  const taken = left.length < state.suggestions[side].length;
  const suggestions = taken ? withSuggestions(state, side, left) : state.suggestions;
  if (pending === null || pending.side === side) {
    return { ...state, suggestions, pending: { side, point }, error: null };
  }
  const points: readonly [SurfacePoint, SurfacePoint] = side === 1 ? [pending.point, point] : [point, pending.point];
  return {
    ...withPairs(state, [...state.pairs, { points, label: '' }]),
    suggestions,
    error: null,
    ...nextInQueue(state, pending.side),
  };
}

/** The next point of a side that waits for its partner. */
function nextInQueue(state: State, side: Side): Pick<State, 'pending' | 'queue'> {
  const [point, ...queue] = state.queue;
  return { pending: point === undefined ? null : { side, point }, queue };
}

/** The pending point given up; the next one has its turn. */
export function withPickDropped(state: State): State {
  return state.pending === null ? state : { ...state, ...nextInQueue(state, state.pending.side) };
}

/** All suggestions of a side, the first one to be paired now. */
export function withAllTaken(state: State, side: Side): State {
  const points = state.suggestions[side].map((suggestion) => suggestion.point);
  const waiting = state.pending?.side === side ? [state.pending.point, ...state.queue] : [];
  const queued = { ...state, queue: [...waiting, ...points] };
  return { ...queued, suggestions: withSuggestions(state, side, []), ...nextInQueue(queued, side) };
}

/** Two pairs with each other's target. */
export function withTargetsExchanged(state: State, indices: readonly number[]): State {
  const [a, b] = indices.map((index) => state.pairs[index]);
  if (a === undefined || b === undefined) {
    return state;
  }
  const given = (pair: Pair, other: Pair): Pair => ({ ...pair, points: [pair.points[0], other.points[1]] });
  return withPairs(
    state,
    state.pairs.map((pair) => (pair === a ? given(a, b) : pair === b ? given(b, a) : pair)),
  );
}

/** One pair less. */
export function withPairDeleted(state: State, index: number): State {
  return withPairs(
    state,
    state.pairs.filter((_, other) => other !== index),
  );
}

/** A pair with another label, which changes no map and is not undone. */
export function withLabel(state: State, index: number, label: string): State {
  return { ...state, pairs: state.pairs.map((pair, other) => (other === index ? { ...pair, label } : pair)) };
}

/** One step back: first the points that wait, then the last change of the pairs. */
export function withUndo(state: State): State {
  if (state.pending !== null) {
    return { ...state, pending: null, queue: [] };
  }
  const last = state.history.at(-1);
  return last === undefined ? state : { ...state, pairs: last, findings: [], history: state.history.slice(0, -1) };
}
