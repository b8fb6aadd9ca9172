/** Landmark files of other programs: saved by a menu, and opened for one mesh alone. */
import type { VNode } from 'preact';
import { formatList } from '../landmark-files.ts';
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';
import type { LandmarkFormatInfo } from '../wasm/page.js';
import type { PartProps } from './actions.ts';
import { choose } from './inputs.tsx';
import { Popover } from './popover.tsx';

/** How a format is called in the menu: what it is, its ending, and how many files it takes. */
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

/** Whether landmarks of these meshes can be put into space. */
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
