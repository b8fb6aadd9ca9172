/** Landmark pairs that do not fit and limbs without one, each with its repair. They stop nothing: the user knows the shapes. */
import { byId, button, make } from '../dom.ts';
import type { Finding } from '../report.ts';
import type { State } from '../store/state.ts';
import type { Actions, Panel } from './panel.ts';

const REPAIRS: Readonly<Record<Finding['repair'], string>> = {
  mirror_target: 'Mirror the target',
  swap: 'Swap these two pairs',
  check: 'Look at this pair',
  mark: 'Show with rings',
};

/** Makes the panel. */
export function findingsPanel(actions: Actions): Panel {
  const root = byId('findings');
  return {
    render(state: State, previous: State | null): void {
      if (previous?.findings === state.findings) {
        return;
      }
      root.hidden = state.findings.length === 0;
      const doubts = state.findings.some((finding) => finding.repair !== 'mark');
      root.replaceChildren(
        make('h2', {}, doubts ? 'Landmarks that do not fit' : 'Limbs without a landmark'),
        ...state.findings.map((finding) =>
          make(
            'div',
            { class: 'finding' },
            make('p', {}, finding.sentence),
            button(REPAIRS[finding.repair], () => {
              actions.repair(finding);
            }),
          ),
        ),
        make(
          'p',
          { class: 'quiet' },
          doubts
            ? 'A repair ends a run that is under way; compute the map again after it. If the pairs are right, there is nothing to do.'
            : 'The map is made all the same. To improve it, add pairs after the run and compute it again.',
        ),
      );
    },
  };
}
