/** Whether the page can compute a map. */
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
    state.pairs.length >= MIN_PAIRS
  );
}
