/** The second step: pairs of places that correspond. */
import type { VNode } from 'preact';
import type { PartProps } from './actions.ts';
import { saveLandmarks } from './exports.ts';
import { choose } from './inputs.tsx';
import { LandmarkTable } from './landmark-table.tsx';
import { ProposalNote } from './proposal.tsx';
import { Suggestions } from './suggestions.tsx';
import { wholePairs } from '../store/order.ts';

function FileButtons({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div class="row">
      <button
        type="button"
        disabled={!state.ready || state.job.kind === 'running'}
        aria-label="Open a landmark file…"
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
          saveLandmarks(state);
        }}
      >
        Save file
      </button>
      <button
        type="button"
        disabled={state.pairs.length === 0}
        onClick={() => {
          actions.dispatch({ kind: 'pairs-cleared' });
        }}
      >
        Clear all
      </button>
    </div>
  );
}

/** The panel's content. */
export function LandmarksPanel({ state, actions }: PartProps): VNode {
  return (
    <div class="content of-landmarks" id="landmarks">
      <FileButtons state={state} actions={actions} />
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
    </div>
  );
}
