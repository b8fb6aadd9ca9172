/** The invitation in an empty view to drop a mesh, and the demos beneath it. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import type { PartProps } from './actions.ts';
import { Gallery } from './gallery.tsx';
import { Icon } from './icons.tsx';
import { choose } from './inputs.tsx';

const ASKS = [
  { title: 'Drop the source here', about: 'The mesh that is carried onto the other.', chooser: 'source-file' },
  { title: 'Drop the target here', about: 'The mesh that the source is mapped onto.', chooser: 'target-file' },
] as const;

/** The drop zone of one view; `null` where there is a mesh. */
export function Invitation({ state, side }: { readonly side: Side } & Pick<PartProps, 'state'>): VNode | null {
  const isRefused = state.refused?.meshes.some((mesh) => mesh.side === side) === true;
  if (state.meshes[side] !== null || isRefused || !state.ready || state.job.kind === 'busy') {
    return null;
  }
  const { title, about, chooser } = ASKS[side];
  return (
    <div class="invitation">
      <Icon name="drop" />
      <h2>{title}</h2>
      <p>{about} A closed surface: OBJ, PLY, STL, OFF, GLB and others.</p>
      <button
        type="button"
        onClick={() => {
          choose(chooser);
        }}
      >
        Choose a file…
      </button>
    </div>
  );
}

/** The line of demos, shown while a view is empty. */
export function DemoLine({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  if (!state.meshes.includes(null) || state.demos.length === 0 || state.job.kind === 'busy') {
    return null;
  }
  return (
    <div class={state.meshes.every((file) => file === null) ? 'demo-line' : 'demo-line small-cards'}>
      <span>Or look at</span>
      <Gallery state={state} actions={actions} />
    </div>
  );
}
