/** The comparison of the map on the page with another one: the section of the step Method, and the captions of the views. */
import type { VNode } from 'preact';
import { lateModule } from '../late-module.ts';
import { OTHER_NAMES } from '../method/compared-words.ts';
import { otherMap } from '../store/compared.ts';
import { shownResult } from '../store/staleness.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { Late } from './late.tsx';

const loadCompare = lateModule(() => import('../method/compare.tsx'));

/** The choice of the map to compare with; `null` where there is no map on the page. */
export function CompareView({ state, actions, shell }: PartProps): VNode | null {
  const result = shownResult(state);
  if (result === null) {
    return null;
  }
  const given = {
    result,
    comparison: state.comparison,
    choose: (other: Parameters<typeof actions.compare>[0]): void => {
      // A comparison needs both views.
      if (other !== null && (shell.state.split === 0 || shell.state.split === 1)) {
        shell.set({ split: 0.5 });
      }
      actions.compare(other);
    },
  };
  return (
    <section id="compare">
      <h3>Compare</h3>
      <Late isWanted load={loadCompare} given={given} />
    </section>
  );
}

/** The caption of each view, which names its map; `null` while no map is compared. */
export function comparedCaptions(state: Pick<State, 'comparison'>): readonly [string, string] | null {
  const { comparison } = state;
  return comparison === null || otherMap(state) === null ? null : ['this map', OTHER_NAMES[comparison.which].caption];
}

/** The bar on the second view that ends the comparison and brings the target back. */
export function CompareBar({ actions }: Pick<PartProps, 'actions'>): VNode {
  return (
    <div class="view-bar" role="group" aria-label="Comparison">
      <button
        type="button"
        class="bare"
        id="end-comparison"
        onClick={() => {
          actions.compare(null);
        }}
      >
        Back to the target
      </button>
    </div>
  );
}
