/** Whether the page can compute a map. */
import { wholePairs } from './order.ts';
import { isCurrent } from './staleness.ts';
import type { State } from './state.ts';

/** The least number of pairs that a map needs: a base domain is at least a tetrahedron. */
export const MIN_PAIRS = 4;

/** Whether a run can start. */
export function canRun(state: State): boolean {
  return (
    state.ready &&
    state.job.kind !== 'running' &&
    state.job.kind !== 'busy' &&
    state.meshes[0] !== null &&
    state.meshes[1] !== null &&
    wholePairs(state).length >= MIN_PAIRS
  );
}

/** Whether a run would make another map than the present one: a map that is up to date and was not finished early stays as it is. */
export function needsRun(state: State): boolean {
  return !isCurrent(state) || state.result?.report.stopped_early === true;
}
