/** The second step, Landmarks: pairs of places that correspond. */
import type { VNode } from 'preact';
import { byId } from '../dom.ts';
import { wholePairs } from '../store/order.ts';
import type { PartProps } from './actions.ts';
import { choose } from './inputs.tsx';
import { LeftAndRight } from './left-right.tsx';
import { LandmarkFormats } from './landmark-formats.tsx';
import { LandmarkTable } from './landmark-table.tsx';
import { FindLandmarks, Matched } from './matching.tsx';
import { ProposalNote } from './proposal.tsx';
import { SoftRadius } from './soft.tsx';
import { Suggestions } from './suggestions.tsx';

function FileButtons({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div class="file-buttons">
      <button
        type="button"
        disabled={!state.ready || state.job.kind === 'running'}
        aria-label="Open landmark files…"
        title="One file, or one for each mesh"
        onClick={() => {
          choose('landmark-file');
        }}
      >
        Open…
      </button>
      <button
        type="button"
        id="save-landmarks"
        aria-label="Save file"
        disabled={wholePairs(state).length === 0}
        onClick={() => {
          actions.saveLandmarks();
        }}
      >
        Save file
      </button>
      <button
        type="button"
        disabled={state.pairs.length === 0}
        onClick={({ detail }) => {
          actions.dispatch({ kind: 'pairs-cleared' });
          // The button is disabled now, which takes the keyboard from it.
          if (detail === 0) {
            byId('panel-title').focus();
          }
        }}
      >
        Clear all
      </button>
      <LandmarkFormats state={state} actions={actions} />
    </div>
  );
}

/** The content of the panel. */
export function LandmarksPanel({ state, actions }: PartProps): VNode {
  return (
    <div class="content of-landmarks" id="landmarks">
      <FileButtons state={state} actions={actions} />
      <FindLandmarks state={state} actions={actions} />
      <Matched state={state} actions={actions} />
      <LeftAndRight state={state} actions={actions} />
      <ProposalNote state={state} actions={actions} />
      <Suggestions state={state} actions={actions} />
      <div class="table">
        {state.pairs.length === 0 ? (
          <p class="nothing quiet">
            No landmarks yet. Click a place on one mesh, then the same place on the other: noses, tips of ears and paws make the
            best pairs.
          </p>
        ) : (
          <LandmarkTable state={state} actions={actions} />
        )}
      </div>
      {/* Below the list, so that its rows stay under the mouse when this comes and goes. */}
      <SoftRadius state={state} actions={actions} />
    </div>
  );
}
