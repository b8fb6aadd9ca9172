/** The base domain in the step Method. */
import type { VNode } from 'preact';
import { useMemo } from 'preact/hooks';
import { pairName } from '../messages.ts';
import { upVector } from '../method/axes.ts';
import type { BaseDomainProps } from '../method/base-domain.tsx';
import { wholePairs } from '../store/order.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { Late } from './late.tsx';

function BaseOf({ state, actions, shell, result }: PartProps & { readonly result: Result }): VNode {
  const { base } = result.output;
  const names = useMemo(() => wholePairs(result.inputs).map(pairName), [result]);
  if (base === null) {
    return <p class="quiet">This map does not tell how its base domain lies on the meshes.</p>;
  }
  const given: BaseDomainProps = {
    base,
    names,
    hands: actions.baseView,
    theme: state.ui.theme,
    isLinked: state.ui.link !== 'free',
    up: [upVector(state.up[0]), upVector(state.up[1])],
    under: shell.state.probe?.patch ?? null,
  };
  return <Late isWanted load={async () => (await import('../method/base-domain.tsx')).default} given={given} />;
}

/** The base domain of the map on the page, or what to do to have one. */
export function BaseView(props: PartProps): VNode {
  const result = shownResult(props.state);
  return (
    <section id="base-domain">
      <h3>The base domain</h3>
      {result === null ? (
        <p class="quiet">Make a map, and the coarse mesh that it goes through comes here.</p>
      ) : (
        <BaseOf key={result.output.report} {...props} result={result} />
      )}
    </section>
  );
}
