/** The invitation in an empty view to drop a mesh, and the demos beneath it. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import type { PartProps } from './actions.ts';
import { Gallery } from './gallery.tsx';
import { Icon } from './icons.tsx';
import { choose } from './inputs.tsx';
import { SIDE_NAMES } from './names.ts';

const ASKS = [
  { title: 'Drop the source here', about: 'The mesh that is carried onto the other.', chooser: 'source-file' },
  { title: 'Drop the target here', about: 'The mesh that the source is mapped onto.', chooser: 'target-file' },
] as const;

/** Whether a view shows neither a mesh nor one that was refused. */
function isEmpty({ meshes, refused }: PartProps['state'], side: Side): boolean {
  return meshes[side] === null && refused?.meshes.some((mesh) => mesh.side === side) !== true;
}

/** The drop zone of an empty view; `null` where there is a mesh. */
export function Invitation({ state, side }: { readonly side: Side } & Pick<PartProps, 'state'>): VNode | null {
  if (!isEmpty(state, side) || !state.ready || state.job.kind === 'busy') {
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

/** The line of demos, shown beneath both views while they are empty, or beneath the empty one. */
export function DemoLine({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  const [first, ...others] = SIDES.filter((side) => isEmpty(state, side));
  if (first === undefined || state.demos.length === 0 || state.job.kind === 'busy') {
    return null;
  }
  return (
    <div class={others.length > 0 ? 'demo-line' : `demo-line small-cards in-${SIDE_NAMES[first]}`}>
      <span>Or look at</span>
      <Gallery state={state} actions={actions} />
    </div>
  );
}
