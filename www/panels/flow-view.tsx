/** The flows of the map's flat metrics in the step Method. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import { shownResult } from '../store/staleness.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';
import { Late } from './late.tsx';

function FlowOf({ actions }: Pick<PartProps, 'actions'>): VNode {
  const [isOpen, setOpen] = useState(false);
  const close = (): void => {
    setOpen(false);
  };
  return (
    <>
      {!isOpen && (
        <>
          <p class="quiet">Each mesh flows to the flat metric of the texture: circles at its vertices grow and shrink until all curvature is at the cones.</p>
          <div class="row">
            <button
              type="button"
              id="watch-flow"
              onClick={() => {
                setOpen(true);
              }}
            >
              <Icon name="play" />
              Watch the flow
            </button>
          </div>
        </>
      )}
      <Late isWanted={isOpen} load={async () => (await import('../method/flow.tsx')).default} given={{ hands: actions.flow, onClose: close }} />
    </>
  );
}

/** The flows of the map on the page. */
export function FlowView({ state, actions }: PartProps): VNode | null {
  const result = shownResult(state);
  return result === null ? null : (
    <section id="flow">
      <h3>The flow</h3>
      <FlowOf key={result.output.report} actions={actions} />
    </section>
  );
}
