/**
 * Landmark pairs that do not fit and limbs without a landmark, each with its repair. They prevent no run, since the user knows the shapes
 * better.
 */
import type { VNode } from 'preact';
import type { Finding } from '../report.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';

const REPAIRS: Readonly<Record<Finding['repair'], string>> = {
  mirror_target: 'Mirror the target',
  swap: 'Swap these two pairs',
  check: 'Look at this pair',
  mark: 'Show with rings',
};

/** The findings; the section is hidden while there are none. */
export function Findings({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const doubts = state.findings.some((finding) => finding.repair !== 'mark');
  return (
    <section id="findings" role="status" hidden={state.findings.length === 0}>
      {state.findings.length > 0 && (
        <>
          <h3>{doubts ? 'Landmarks that do not fit' : 'Limbs without a landmark'}</h3>
          {state.findings.map((finding) => (
            <div class="note" key={finding.sentence}>
              <Icon name="doubt" />
              <div>
                <p>{finding.sentence}</p>
                <button
                  type="button"
                  onClick={() => {
                    actions.repair(finding);
                  }}
                >
                  {REPAIRS[finding.repair]}
                </button>
              </div>
            </div>
          ))}
          <p class="quiet small">
            {doubts
              ? 'A repair ends a run that is under way; make the map again after it. If the pairs are right, there is nothing to do.'
              : 'The map is made all the same. To improve it, add pairs after the run and make it again.'}
          </p>
        </>
      )}
    </section>
  );
}
