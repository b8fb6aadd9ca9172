/** Replaces the landmarks of one mesh by those of a file for that mesh alone. */
import type { Pair, Side, SurfacePoint } from '../landmarks.ts';
import { isSamePoint, otherSide } from '../landmarks.ts';
import { pairLocked } from '../messages.ts';
import { withNewPairs } from './pairs.ts';
import type { State } from './state.ts';

/** A point of one mesh with its label, which is empty for none. */
export interface SidePoint {
  readonly label: string;
  readonly point: SurfacePoint;
}

function pointsOf(side: Side, point: SurfacePoint | null, partner: SurfacePoint | null): Pair['points'] {
  return side === 0 ? [point, partner] : [partner, point];
}

/** The index of each label; `null` where a label is empty or occurs twice. */
function byLabel(labels: readonly string[]): ReadonlyMap<string, number> | null {
  const places = new Map(labels.map((label, index) => [label, index]));
  return places.size === labels.length && !places.has('') ? places : null;
}

/**
 * The points for the waiting pairs, in the pairs' order: matched by equal labels, else by order; `null` where the numbers of pairs and
 * points differ.
 */
function partners(pairs: readonly Pair[], points: readonly SidePoint[]): readonly SidePoint[] | null {
  if (pairs.length !== points.length) {
    return null;
  }
  const places = byLabel(points.map(({ label }) => label));
  if (places !== null && byLabel(pairs.map(({ label }) => label)) !== null) {
    const found = pairs.flatMap(({ label }) => points[places.get(label) ?? -1] ?? []);
    if (found.length === points.length) {
      return found;
    }
  }
  return points;
}

/**
 * The state with points in place of those on one mesh. They complete the pairs that have a point on the other mesh, where there are equally
 * many; otherwise all points are half pairs that wait.
 */
export function withSideMarks(state: State, side: Side, points: readonly SidePoint[]): State {
  const across = otherSide(side);
  const others = state.pairs.filter((pair) => pair.points[across] !== null);
  const found = partners(others, points);
  const point = (index: number): SurfacePoint | null => found?.[index]?.point ?? null;
  const locked = state.pairs.find((pair) => {
    const index = others.indexOf(pair);
    return pair.locked && pair.points[side] !== null && !isSamePoint(pair.points[side], index < 0 ? null : point(index));
  });
  if (locked !== undefined) {
    return { ...state, error: pairLocked(locked.number) };
  }
  const pairs = others.map((pair, index) => ({
    ...pair,
    label: pair.label === '' ? (found?.[index]?.label ?? '') : pair.label,
    points: pointsOf(side, point(index), pair.points[across]),
  }));
  const rest = found === null ? points : [];
  const halves = rest.map((mark) => ({ points: pointsOf(side, mark.point, null), label: mark.label }));
  return withNewPairs({ ...state, pairs, error: null }, halves);
}
