/** Which points the views mark. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import type { State } from './state.ts';

/** Points of one side in pair order; the pending pair last, `null` where it is not picked yet. */
export function pointsOf(state: State, side: Side): (SurfacePoint | null)[] {
  const points: (SurfacePoint | null)[] = state.pairs.map((pair) => pair.points[side]);
  if (state.pending !== null) {
    points.push(state.pending.side === side ? state.pending.point : null);
  }
  return points;
}
