/** Half pairs, and which of them a click completes. */
import type { Pair, Side } from '../landmarks.ts';
import { otherSide } from '../landmarks.ts';
import type { State } from './state.ts';

type Asking = Pick<State, 'pairs' | 'ui'>;

/**
 * The pair that a point picked on this side completes: the selected one, else the first one that lacks a point there; `null` where the
 * point begins a pair.
 */
export function waitingFor({ pairs, ui }: Asking, side: Side): Pair | null {
  const lacks = pairs.filter(({ points }) => points[side] === null);
  return lacks.find(({ id }) => id === ui.selected) ?? lacks[0] ?? null;
}

/** The side on which a half pair lacks its point; `null` for a pair with both points. */
export function missingSide(pair: Pair): Side | null {
  return pair.points[0] === null ? 0 : pair.points[1] === null ? 1 : null;
}

/** What the page asks for now: the half pair whose turn it is, and the side to click; `null` where nothing waits. */
export function asked(state: Asking): { readonly pair: Pair; readonly side: Side } | null {
  const halves = state.pairs.filter((pair) => missingSide(pair) !== null);
  const pair = halves.find(({ id }) => id === state.ui.selected) ?? halves[0];
  const side = pair === undefined ? null : missingSide(pair);
  return pair === undefined || side === null ? null : { pair, side };
}

/** The number of half pairs that have a point on the other side and none on this one. */
export function waitingCount({ pairs }: Pick<State, 'pairs'>, missing: Side): number {
  return pairs.filter(({ points }) => points[missing] === null && points[otherSide(missing)] !== null).length;
}
