/** Writes the state of the page into attributes of the body, for styles and tests. */
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';

export function mark(state: State): void {
  const { dataset } = document.body;
  dataset['ready'] = String(state.ready);
  dataset['state'] = state.job.kind;
  dataset['pairs'] = String(wholePairs(state).length);
  dataset['demo'] = state.demo?.id ?? '';
}
