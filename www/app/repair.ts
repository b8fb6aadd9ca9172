/** Does what a finding about the landmarks asks for. */
import { mirroredTarget } from '../files.ts';
import type { Doubt } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { Runner } from './run.ts';
import { lettered } from './suggest.ts';
import { sentenceOf } from './task.ts';

/** Repairs; a run with the old pairs ends. `lookAtPair` brings a pair before the user's eyes. */
export function repair(store: Store, runner: Runner, lookAtPair: (id: number) => void, finding: Doubt): void {
  const { state, dispatch } = store;
  try {
    switch (finding.repair) {
      case 'swap':
        runner.cancel();
        dispatch({ kind: 'targets-exchanged', ids: finding.ids });
        break;
      case 'mirror_target': {
        const target = state.meshes[1];
        if (target !== null) {
          const event = mirroredTarget(target, state.pairs);
          runner.cancel();
          dispatch(event);
        }
        break;
      }
      case 'mark':
        if (finding.side !== null) {
          const ends = finding.vertices.map((point) => ({ point, reason: 'tip' as const, partner: null }));
          dispatch({ kind: 'suggested', side: finding.side, suggestions: lettered(ends) });
        }
        break;
      case 'check':
        if (finding.ids[0] !== undefined) {
          dispatch({ kind: 'pair-selected', id: finding.ids[0] });
          lookAtPair(finding.ids[0]);
        }
        break;
    }
  } catch (thrown) {
    dispatch({ kind: 'error', sentence: sentenceOf(thrown) });
  }
}
