/** The section with the parts of the method that can be watched on the meshes, one at a time. */
import type { VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { lateModule } from '../late-module.ts';
import { shownResult } from '../store/staleness.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';
import { Late } from './late.tsx';

type Part = 'flow' | 'simplification';

const loadFlow = lateModule(() => import('../method/flow.tsx'));
const loadSimplification = lateModule(() => import('../method/simplification.tsx'));

interface ButtonProps {
  readonly part: Part;
  readonly about: string;
  readonly onOpen: () => void;
}

function WatchButton({ part, about, onOpen }: ButtonProps): VNode {
  return (
    <>
      <p class="quiet">{about}</p>
      <div class="row">
        <button type="button" id={`watch-${part}`} onClick={onOpen}>
          <Icon name="play" />
          Watch the {part}
        </button>
      </div>
    </>
  );
}

function PartsOf({ state, actions, shell, isCarried }: PartProps & { readonly isCarried: boolean }): VNode {
  const [open, setOpen] = useState<Part | null>(null);
  const close = (): void => {
    setOpen(null);
  };
  const opens = (part: Part) => (): void => {
    // The views show only one thing at a time.
    actions.compare(null);
    setOpen(part);
  };
  useEffect(() => {
    if (state.comparison !== null) {
      close();
    }
  }, [state.comparison]);
  return (
    <>
      <section id="simplification">
        <h3>The simplification</h3>
        {open === 'simplification' ? (
          <Late isWanted load={loadSimplification} given={{ hands: actions.simplification, places: shell.state.probe?.positions ?? null, isCarried, onClose: close }} />
        ) : (
          <WatchButton
            part="simplification"
            about="A base domain in the way of the thesis: edge after edge is collapsed, least change first, until the landmarks are left: on each mesh by itself, or on one of both and carried to the other. By default the map goes over one that is planned on both meshes together."
            onOpen={opens('simplification')}
          />
        )}
      </section>
      <section id="flow">
        <h3>The flow</h3>
        {open === 'flow' ? (
          <Late isWanted load={loadFlow} given={{ hands: actions.flow, onClose: close }} />
        ) : (
          <WatchButton
            part="flow"
            about="Each mesh flows to the flat metric of the texture: circles at its vertices grow and shrink until all curvature is at the cones."
            onOpen={opens('flow')}
          />
        )}
      </section>
    </>
  );
}

/** What can be watched for the map on the page; `null` where there is none. */
export function WatchView({ state, actions, shell }: PartProps): VNode | null {
  const result = shownResult(state);
  return result === null ? null : <PartsOf key={result.output.report} state={state} actions={actions} shell={shell} isCarried={result.output.map !== null} />;
}
