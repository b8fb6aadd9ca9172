/** The flows of the map on the page to its flat metrics, for the heat maps that show them. */
import type { Flows } from '../compute/watch-messages.ts';
import { shownStyle } from './compared.ts';
import { shownResult } from './staleness.ts';
import type { State } from './state.ts';
import { isFlowHeat } from './surfaces.ts';

/** Whether somebody looks at a heat map whose flows are to be computed. */
export function wantsFlows(state: State): boolean {
  const { job, flattening } = state;
  const isFree = job.kind !== 'running' && job.kind !== 'busy';
  return isFree && flattening === null && shownResult(state) !== null && isFlowHeat(shownStyle(state).surface);
}

/** The state without flows that are not of the map on the page: who comes back to their map has them computed again. */
export function withOwnFlows(state: State): State {
  const { flattening } = state;
  return flattening === null || flattening.of === shownResult(state) ? state : { ...state, flattening: null };
}

/** The flows, where they are there to be shown. */
export function shownFlows({ flattening }: Pick<State, 'flattening'>): Flows | null {
  return flattening?.progress.kind === 'there' ? flattening.progress.flows : null;
}
