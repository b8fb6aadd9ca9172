/** Writes the state of the page into attributes of the body, for styles and tests. */
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';

export function mark(state: State): void {
  const { dataset } = document.body;
  const attributes = {
    ready: String(state.ready),
    state: state.job.kind,
    pairs: String(wholePairs(state).length),
    demo: state.demo?.id ?? '',
  };
  for (const [name, value] of Object.entries(attributes)) {
    // The styles of the whole page are computed anew when an attribute is written, even where it stays the same.
    if (dataset[name] !== value) {
      dataset[name] = value;
    }
  }
}
