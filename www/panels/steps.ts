/** The progress of each step of the work, and the step that opens by itself. */
import { wholePairs } from '../store/order.ts';
import { canRun, MIN_PAIRS } from '../store/readiness.ts';
import { isCurrent, shownResult } from '../store/staleness.ts';
import type { State } from '../store/state.ts';

export type Step = State['ui']['step'];
export const STEPS: readonly Step[] = ['meshes', 'landmarks', 'map', 'use', 'method'];

export type Mark = 'empty' | 'ready' | 'running' | 'done' | 'outdated';

function hasMeshes(state: State): boolean {
  return !state.meshes.includes(null);
}

function hasPairs(state: State): boolean {
  return wholePairs(state).length >= MIN_PAIRS;
}

/** The mark that shows the progress of a step. */
export function markOf(state: State, step: Step): Mark {
  const result = shownResult(state) === null ? null : isCurrent(state) ? 'done' : 'outdated';
  switch (step) {
    case 'meshes':
      return state.job.kind === 'busy' ? 'running' : hasMeshes(state) ? 'done' : 'empty';
    case 'landmarks':
      if (state.findings.some((finding) => finding.repair !== 'mark')) {
        return 'outdated';
      }
      return hasPairs(state) ? 'done' : hasMeshes(state) ? 'ready' : 'empty';
    case 'map':
      return state.job.kind === 'running' ? 'running' : (result ?? (canRun(state) ? 'ready' : 'empty'));
    case 'use':
    case 'method':
      return result === null ? 'empty' : result === 'done' ? 'ready' : 'outdated';
  }
}

/** The step that opens after a change; `null` where the open step stays. */
export function stepAfter(state: State, previous: State): Step | null {
  if (state.job.kind === 'running' && previous.job.kind !== 'running') {
    return 'map';
  }
  if (state.result !== previous.result && state.result !== null && state.result.opened !== null) {
    return 'map';
  }
  if (state.refused !== null && state.refused !== previous.refused && state.refused.meshes.some((mesh) => previous.refused?.meshes.includes(mesh) !== true)) {
    // The step Meshes lists what is wrong with the refused mesh.
    return 'meshes';
  }
  if (state.matching?.kind === 'found' && previous.matching?.kind === 'searching') {
    // The step Landmarks says how sure the pairs are.
    return 'landmarks';
  }
  if (state.history.past.length <= previous.history.past.length) {
    // Nothing is new: a step was taken back.
    return null;
  }
  if (state.meshes !== previous.meshes && hasMeshes(state) && state.meshes[0] !== previous.meshes[1]) {
    return hasPairs(state) ? 'map' : 'landmarks';
  }
  // A landmark file has come to meshes that were there already.
  return state.ui.step === 'meshes' && hasMeshes(state) && hasPairs(state) && !hasPairs(previous) ? 'map' : null;
}
