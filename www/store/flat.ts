/** The flows of the map on the page to its flat metrics, for the heat maps that show them. */
import type { Flows } from '../compute/watch-messages.ts';
import { shownStyle } from './compared.ts';
import { shownResult } from './staleness.ts';
import type { Flattening, State, Style } from './state.ts';

/** The heat maps that flows tell. */
const OF_FLOWS = ['factor', 'curvature', 'flat-curvature'] as const;

/** Whether a surface shows what the flows tell. */
export function needsFlows(surface: Style['surface']): surface is (typeof OF_FLOWS)[number] {
  return OF_FLOWS.some((one) => one === surface);
}

/** Whether somebody looks at a heat map whose flows are to be computed. */
export function wantsFlows(state: State): boolean {
  const { job, flattening } = state;
  const isFree = job.kind !== 'running' && job.kind !== 'busy';
  const of = shownResult(state);
  return isFree && of !== null && needsFlows(shownStyle(state).surface) && flattening?.of !== of;
}

/** Flows of the map on the page begin, go on, are there, or failed; what is of another map is left out. */
export function withFlattening(state: State, flattening: Flattening): State {
  return flattening.of === shownResult(state) ? { ...state, flattening } : state;
}

/** The flows, where they are there to be shown. */
export function shownFlows(state: State): Flows | null {
  const { flattening } = state;
  return flattening?.progress.kind === 'there' && flattening.of === shownResult(state) ? flattening.progress.flows : null;
}
