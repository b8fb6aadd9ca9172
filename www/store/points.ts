/** The points that the views mark. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import type { State } from './state.ts';

/** The points of one side at the index of their pair's number less 1, so that number and colour agree; `null` where there is none. */
export function pointsOf({ pairs }: Pick<State, 'pairs'>, side: Side): (SurfacePoint | null)[] {
  const most = pairs.reduce((highest, { number }) => Math.max(highest, number), 0);
  const points = Array.from<SurfacePoint | null>({ length: most }).fill(null);
  for (const pair of pairs) {
    points[pair.number - 1] = pair.points[side];
  }
  return points;
}
