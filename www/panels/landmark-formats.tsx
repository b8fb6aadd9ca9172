/** The menu for landmark files of other programs: it saves them, and opens those for one mesh alone. */
import type { VNode } from 'preact';
import { formatList } from '../landmark-files.ts';
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';
import type { LandmarkFormatInfo } from '../wasm/page.js';
import type { PartProps } from './actions.ts';
import { choose } from './inputs.tsx';
import { Popover } from './popover.tsx';

/** The name of a format in the menu: its title, its ending, and `2 ×` where it needs a file for each mesh. */
function formatName({ title, ending, holds }: LandmarkFormatInfo): string {
  return `${title} (${holds === 'one' ? '2 × ' : ''}.${ending})`;
}

const SIDES = [
  ['source', 'landmarks-of-source'],
  ['target', 'landmarks-of-target'],
] as const;

interface MenuProps extends Pick<PartProps, 'state' | 'actions'> {
  readonly close: () => void;
}

/** Whether both meshes are on the page, which formats with positions in space need. */
function areMeshesThere({ meshes }: State): boolean {
  return meshes[0] !== null && meshes[1] !== null;
}

function Menu({ state, actions, close }: MenuProps): VNode {
  const canSave = wholePairs(state).length > 0;
  return (
    <>
      <p class="title">Save as</p>
      {formatList().map((format) => (
        <button
          key={format.id}
          type="button"
          data-format={format.id}
          title={format.holds === 'one' ? 'Two files, one for each mesh and called after it' : 'One file for both meshes'}
          disabled={!canSave || (format.id !== 'conemap' && !areMeshesThere(state))}
          onClick={() => {
            close();
            actions.saveLandmarks(format.id);
          }}
        >
          {formatName(format)}
        </button>
      ))}
      <p class="title">Open for one mesh</p>
      {SIDES.map(([name, chooser], side) => (
        <button
          key={name}
          type="button"
          disabled={state.job.kind === 'running' || state.meshes[side] === null}
          onClick={() => {
            close();
            choose(chooser);
          }}
        >
          For the {name} alone…
        </button>
      ))}
    </>
  );
}

/** The menu behind a button. */
export function LandmarkFormats({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <Popover icon="more" id="landmark-formats" label="More landmark formats" place="down end" disabled={!state.ready}>
      {(close) => <Menu state={state} actions={actions} close={close} />}
    </Popover>
  );
}
