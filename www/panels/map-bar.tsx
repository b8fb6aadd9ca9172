/** The bar on the source's view with what a map can show there. */
import type { VNode } from 'preact';
import { shownResult } from '../store/staleness.ts';
import type { PartProps } from './actions.ts';
import { Morph } from './morph.tsx';
import { WipeButton } from './wipe.tsx';

/** The bar; `null` without a map. */
export function MapBar({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  if (shownResult(state) === null) {
    return null;
  }
  return (
    <div class="map-bar" role="group" aria-label="The map on the source">
      <Morph state={state} actions={actions} />
      <WipeButton state={state} actions={actions} />
    </div>
  );
}
