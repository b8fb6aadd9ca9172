/** The map on the page beside another one: the section of the step Method, and what the views say of it. */
import type { VNode } from 'preact';
import { lateModule } from '../late-module.ts';
import { OTHER_NAMES } from '../method/compared-words.ts';
import { otherMap } from '../store/compared.ts';
import { shownResult } from '../store/staleness.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { Late } from './late.tsx';

const loadCompare = lateModule(() => import('../method/compare.tsx'));

/** What the map on the page can be compared with, where there is one. */
export function CompareView({ state, actions, shell }: PartProps): VNode | null {
  const result = shownResult(state);
  if (result === null) {
    return null;
  }
  const given = {
    result,
    comparison: state.comparison,
    choose: (other: Parameters<typeof actions.compare>[0]): void => {
      // Two maps are compared in two views.
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

/** Whose map the views show, by their order; `null` while none is compared. */
export function comparedCaptions(state: Pick<State, 'comparison'>): readonly [string, string] | null {
  const { comparison } = state;
  return comparison === null || otherMap(state) === null ? null : ['this map', OTHER_NAMES[comparison.which].caption];
}

/** Brings the target back, on its view. */
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
