/** A button that goes through the places where a map is worst. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import type { Result } from '../store/state.ts';
import type { Actions } from './actions.ts';
import { largestStretch } from './verdict.ts';

/** Turns both views to the worst places, one after the other; the report has at most ten. */
export function WorstPlaces({ result, actions }: { readonly result: Result; readonly actions: Actions }): VNode | null {
  const [seen, setSeen] = useState({ result, count: 0 });
  const { worst } = result.report.distortion;
  const count = seen.result === result ? seen.count : 0;
  const shown = worst[count - 1];
  if (worst.length === 0) {
    return null;
  }
  return (
    <div class="worst-places">
      <button
        type="button"
        id="next-worst"
        onClick={() => {
          const place = worst[count % worst.length];
          setSeen({ result, count: (count % worst.length) + 1 });
          if (place !== undefined) {
            actions.lookAtPlaces([place.source, place.target]);
          }
        }}
      >
        {count === 0 ? 'Show the worst place' : 'Next worst place'}
      </button>
      <p class="quiet small" role="status">
        {shown !== undefined && `${count} of ${worst.length}: up to ${largestStretch(shown.density).toFixed(1)} times`}
      </p>
    </div>
  );
}
