/** How far the point of a soft pair may be moved. */
import type { VNode } from 'preact';
import { MAX_RADIUS } from '../landmarks.ts';
import type { PartProps } from './actions.ts';

/** The radius of the selected pair, where that is soft, in percent of the target's size. */
export function SoftRadius({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  const pair = state.pairs.find(({ id }) => id === state.ui.selected);
  if (pair?.radius === undefined) {
    return null;
  }
  const { id, number, radius } = pair;
  return (
    <div class="soft-radius">
      <label>
        Pair {number} may move by{' '}
        <input
          type="number"
          min={0.1}
          max={100 * MAX_RADIUS}
          step={0.1}
          value={Number((100 * radius).toFixed(2))}
          aria-label={`Radius of pair ${number}, in percent of the target’s size`}
          onChange={(event) => {
            const percent = event.currentTarget.valueAsNumber;
            const limited = Math.min(Math.max(percent, 0.1), 100 * MAX_RADIUS);
            event.currentTarget.valueAsNumber = Number.isNaN(percent) ? 100 * radius : limited;
            if (!Number.isNaN(percent)) {
              actions.dispatch({ kind: 'pair-softened', id, radius: limited / 100 });
            }
          }}
        />{' '}
        % of the target’s size
      </label>
      <p class="quiet small">When the map is made, its point on the target goes to where the map around it leads, and is held there.</p>
    </div>
  );
}
