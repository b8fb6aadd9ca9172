/** Changes of the landmark pairs. A change that is refused shows the reason and leaves the pairs as they are. */
import type { Pair, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import { isSamePoint, otherSide, rounded } from '../landmarks.ts';
import { pairLocked, pointTaken, SENTENCES } from '../messages.ts';
import { proposed } from './proposal.ts';
import type { State } from './state.ts';
import { asked, waitingFor } from './waiting.ts';

/** The points of a pair, with the one of a side replaced. */
export function withPoint(points: Pair['points'], side: Side, point: SurfacePoint | null): Pair['points'] {
  return side === 0 ? [point, points[1]] : [points[0], point];
}

/** The pairs, with the one that has this pair's id replaced by it. */
export function replaced(pairs: readonly Pair[], pair: Pair): readonly Pair[] {
  return pairs.map((other) => (other.id === pair.id ? pair : other));
}

export function pairOf(state: State, id: number): Pair | null {
  return state.pairs.find((pair) => pair.id === id) ?? null;
}

export function selecting(state: State, selected: number | null): State {
  return state.ui.selected === selected ? state : { ...state, ui: { ...state.ui, selected } };
}

/** The suggestions of both sides, with those of one side replaced. */
export function withSuggestions(state: State, side: Side, suggestions: readonly Suggestion[]): State['suggestions'] {
  return side === 0 ? [suggestions, state.suggestions[1]] : [state.suggestions[0], suggestions];
}

/** The number of the next new pair. */
export function numberAfter(pairs: readonly Pair[]): number {
  return pairs.reduce((most, { number }) => Math.max(most, number), 0) + 1;
}

/** Adds pairs of these points, with the next ids and numbers. */
export function withNewPairs(state: State, made: readonly Pick<Pair, 'points' | 'label' | 'radius'>[]): State {
  const first = numberAfter(state.pairs);
  const pairs = made.map((pair, index) => ({ ...pair, id: state.nextId + index, number: first + index, locked: false }));
  return { ...state, pairs: [...state.pairs, ...pairs], nextId: state.nextId + made.length };
}

/** The pair that has this point on a side, other than the pair `except`; `null` for none. */
export function holder(state: State, side: Side, point: SurfacePoint, except: number | null): Pair | null {
  return state.pairs.find(({ id, points }) => id !== except && isSamePoint(points[side], point)) ?? null;
}

/** Picks a point of one side, which begins a pair or completes one. */
export function withPick(state: State, side: Side, picked: SurfacePoint): State {
  const point = rounded(picked);
  const other = holder(state, side, point, null);
  if (other !== null) {
    return { ...state, error: pointTaken(side, other.number) };
  }
  const left = state.suggestions[side].filter((suggestion) => suggestion.point !== point);
  const taken = left.length < state.suggestions[side].length;
  const suggestions = taken ? withSuggestions(state, side, left) : state.suggestions;
  const present = { ...state, suggestions, error: null };
  const half = waitingFor(state, side);
  if (half === null) {
    // Half pairs that were begun earlier are completed first.
    const turn = asked(state);
    const begun = withNewPairs(present, [{ points: withPoint([null, null], side, point), label: '' }]);
    return selecting(begun, turn?.side === otherSide(side) ? turn.pair.id : state.nextId);
  }
  return withCompleted(present, half, side, point);
}

/** Completes a half pair; the next pair that lacks a point on this side gets its turn. */
function withCompleted(state: State, half: Pair, side: Side, point: SurfacePoint): State {
  const pairs = replaced(state.pairs, { ...half, points: withPoint(half.points, side, point) });
  const next = pairs.find(({ points }) => points[side] === null);
  return selecting({ ...state, pairs }, next?.id ?? half.id);
}

/** Completes the half pair whose turn it is with the place that the map proposes. */
export function withProposalAccepted(state: State): State {
  const proposal = proposed(state);
  const half = proposal === null ? null : pairOf(state, proposal.id);
  if (proposal === null || half === null) {
    return state;
  }
  const { side } = proposal;
  const point = rounded(proposal.point);
  const other = holder(state, side, point, null);
  return other === null
    ? withCompleted({ ...state, proposal: null, error: null }, half, side, point)
    : { ...state, error: pointTaken(side, other.number) };
}

/** Moves a point of a pair on its surface. */
export function withPointMoved(state: State, id: number, side: Side, moved: SurfacePoint): State {
  const pair = pairOf(state, id);
  const point = rounded(moved);
  if (pair === null || isSamePoint(pair.points[side], point)) {
    return state;
  }
  if (pair.locked) {
    return { ...state, error: pairLocked(pair.number) };
  }
  const other = holder(state, side, point, id);
  if (other !== null) {
    return { ...state, error: pointTaken(side, other.number) };
  }
  const pairs = replaced(state.pairs, { ...pair, points: withPoint(pair.points, side, point) });
  return selecting({ ...state, pairs, error: null }, id);
}

/** Gives up the half pair whose turn it is; the next one gets its turn. */
export function withPickDropped(state: State): State {
  const turn = asked(state);
  if (turn === null) {
    return selecting(state, null);
  }
  const pairs = state.pairs.filter((pair) => pair !== turn.pair);
  const next = waitingFor({ pairs, ui: state.ui }, turn.side);
  return selecting({ ...state, pairs }, next?.id ?? null);
}

/** Takes all suggestions of a side as half pairs; the first one is to be completed now. */
export function withAllTaken(state: State, side: Side): State {
  const free = state.suggestions[side].filter(({ point }) => holder(state, side, point, null) === null);
  const halves = free.map(({ point }) => ({ points: withPoint([null, null], side, point), label: '' }));
  const taken = withNewPairs({ ...state, suggestions: withSuggestions(state, side, []) }, halves);
  const turn = waitingFor(taken, otherSide(side));
  return turn === null ? taken : selecting(taken, turn.id);
}

/** Exchanges the targets of two pairs. */
export function withTargetsExchanged(state: State, ids: readonly number[]): State {
  const [a, b] = ids.map((id) => pairOf(state, id));
  if (a === undefined || b === undefined || a === null || b === null || a === b) {
    return state;
  }
  const locked = [a, b].find((pair) => pair.locked);
  if (locked !== undefined) {
    return { ...state, error: pairLocked(locked.number) };
  }
  const given = (pair: Pair, other: Pair): Pair => ({ ...pair, points: [pair.points[0], other.points[1]] });
  return { ...state, pairs: replaced(replaced(state.pairs, given(a, b)), given(b, a)) };
}

/** Deletes a pair; the next one in the list is selected instead. */
export function withPairDeleted(state: State, id: number): State {
  const index = state.pairs.findIndex((pair) => pair.id === id);
  const pair = state.pairs[index];
  if (pair === undefined) {
    return state;
  }
  if (pair.locked) {
    return { ...state, error: pairLocked(pair.number) };
  }
  const pairs = state.pairs.filter((other) => other !== pair);
  const selected = state.ui.selected === id ? (pairs[Math.min(index, pairs.length - 1)]?.id ?? null) : state.ui.selected;
  return selecting({ ...state, pairs }, selected);
}

/** Deletes all pairs but the locked ones. */
export function withPairsCleared(state: State): State {
  const pairs = state.pairs.filter(({ locked }) => locked);
  if (pairs.length === state.pairs.length) {
    return pairs.length === 0 ? state : { ...state, error: SENTENCES.allLocked };
  }
  return { ...state, pairs };
}

/** Changes the label of a pair. */
export function withLabel(state: State, id: number, label: string): State {
  const pair = pairOf(state, id);
  return pair === null || pair.label === label ? state : { ...state, pairs: replaced(state.pairs, { ...pair, label }) };
}

/** Locks or unlocks a pair. */
export function withLock(state: State, id: number, locked: boolean): State {
  const pair = pairOf(state, id);
  return pair === null || pair.locked === locked ? state : { ...state, pairs: replaced(state.pairs, { ...pair, locked }) };
}

/** Moves a pair to another index of the list. */
export function withPairAt(state: State, id: number, to: number): State {
  const pair = pairOf(state, id);
  if (pair === null || !Number.isInteger(to)) {
    return state;
  }
  const others = state.pairs.filter((other) => other !== pair);
  const place = Math.min(Math.max(to, 0), others.length);
  return state.pairs[place] === pair ? state : { ...state, pairs: [...others.slice(0, place), pair, ...others.slice(place)] };
}
