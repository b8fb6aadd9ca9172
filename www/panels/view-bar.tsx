/** The camera's buttons on a view. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';
import { SIDE_NAMES } from './names.ts';

/** The bar of one view. */
export function ViewBar({ state, actions, shell, side }: { readonly side: Side } & PartProps): VNode | null {
  if (state.meshes[side] === null) {
    return null;
  }
  const { split } = shell.state;
  const alone = side === 0 ? 1 : 0;
  return (
    <div class="view-bar" role="toolbar" aria-label={`Camera of the ${SIDE_NAMES[side]}`}>
      <IconButton
        icon="fit"
        label={`Show the whole ${SIDE_NAMES[side]}`}
        onClick={() => {
          actions.fit(side);
        }}
      />
      <IconButton
        icon="wide"
        label={split === alone ? 'Show both views' : `Show the ${SIDE_NAMES[side]} alone`}
        pressed={split === alone}
        onClick={() => {
          shell.set({ split: split === alone ? 0.5 : alone });
        }}
      />
    </div>
  );
}
