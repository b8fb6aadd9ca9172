/** The main action at the top of every panel: what to do now. */
import type { VNode } from 'preact';
import { integer } from '../numbers.ts';
import { expectedMemory, mayExceedMemory } from '../store/memory.ts';
import { wholePairs } from '../store/order.ts';
import { canRun, MIN_PAIRS } from '../store/readiness.ts';
import { shownResult, staleness } from '../store/staleness.ts';
import type { State } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import { choose } from './inputs.tsx';
import { FindLandmarks } from './matching.tsx';
import { meshName } from './names.ts';

/** The warning that a map of these meshes may need more memory than the page can have. */
function tooLarge(state: State): string {
  const faces = state.meshes.reduce((sum, mesh) => sum + (mesh?.faceCount ?? 0), 0);
  const needed = (expectedMemory(state) / 2 ** 30).toFixed(1);
  return `A map of ${integer(faces)} triangles may take ${needed} GiB of memory, more than the 4 GiB that a page can have. The command line has no such limit; or take fewer triangles.`;
}

/** Why no map can be made, or else what it would be made from. */
export function reason(state: State): string {
  const pairs = wholePairs(state).length;
  if (!state.ready) {
    return 'Loading…';
  }
  if (state.meshes.includes(null)) {
    return 'A map needs a source and a target mesh.';
  }
  if (pairs < MIN_PAIRS) {
    return `${pairs} of at least ${MIN_PAIRS} landmark pairs.`;
  }
  if (mayExceedMemory(state)) {
    return tooLarge(state);
  }
  if (shownResult(state) === null) {
    return `With ${pairs} landmark pairs.`;
  }
  return staleness(state) === null ? 'The map shown is current.' : 'Something has changed since the map shown.';
}

function FinishOrCancel({ state, actions }: { readonly state: State; readonly actions: Actions }): VNode {
  const finishable = state.job.kind === 'running' && state.job.finish === 'possible';
  return (
    <>
      <div class="twins">
        <button type="button" class="main" disabled={!finishable} onClick={actions.finish}>
          <span>Finish now</span>
        </button>
        <button type="button" onClick={actions.cancel}>
          Cancel
        </button>
      </div>
      <p class="reason">A map finished early is whole and proven, too.</p>
    </>
  );
}

/** The button of the main action, and the line that explains its state. */
export function MainAction({ state, actions }: PartProps): VNode {
  const missing = state.meshes.includes(null);
  const { step } = state.ui;
  if (state.job.kind === 'running') {
    return <FinishOrCancel state={state} actions={actions} />;
  }
  if (step === 'meshes' && missing) {
    return (
      <>
        <button
          type="button"
          class="main"
          disabled={!state.ready}
          onClick={() => {
            choose('mesh-files');
          }}
        >
          <span>Open meshes…</span>
        </button>
        <p class="reason">{state.ready ? 'Both at once, with their landmark file if there is one.' : 'Loading…'}</p>
      </>
    );
  }
  if (step === 'meshes' && wholePairs(state).length < MIN_PAIRS) {
    return (
      <>
        <button
          type="button"
          class="main"
          onClick={() => {
            actions.dispatch({ kind: 'ui', ui: { step: 'landmarks' } });
          }}
        >
          <span>Place landmarks</span>
        </button>
        <FindLandmarks state={state} actions={actions} />
        <p class="reason">{reason(state)}</p>
      </>
    );
  }
  return (
    <>
      <button type="button" id="run" class="main" disabled={!canRun(state)} onClick={actions.run}>
        <span>{missing ? 'Make the map' : `Map ${meshName(state, 0)} onto ${meshName(state, 1)}`}</span>
      </button>
      <p class="reason">{reason(state)}</p>
    </>
  );
}
