/** The flows of the map on the page to its flat metrics, for heat maps that show their values. */
import type { Flows } from '../compute/watch-messages.ts';
import { shownStyle } from './compared.ts';
import { shownResult } from './staleness.ts';
import type { State } from './state.ts';
import { isFlowHeat } from './surfaces.ts';

/** Whether a heat map is shown whose flows have yet to be computed. */
export function wantsFlows(state: State): boolean {
  const { job, flattening } = state;
  const isFree = job.kind !== 'running' && job.kind !== 'busy';
  return isFree && flattening === null && shownResult(state) !== null && isFlowHeat(shownStyle(state).surface);
}

/** The state without flows that are not of the map on the page; they are computed again when their map comes back. */
export function withOwnFlows(state: State): State {
  const { flattening } = state;
  return flattening === null || flattening.of === shownResult(state) ? state : { ...state, flattening: null };
}

/** The flows, once they are computed; `null` otherwise. */
export function shownFlows({ flattening }: Pick<State, 'flattening'>): Flows | null {
  return flattening?.progress.kind === 'there' ? flattening.progress.flows : null;
}
