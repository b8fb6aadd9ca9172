/** Does what a finding about the landmarks asks for. */
import { mirroredTarget } from '../files.ts';
import type { Finding } from '../report.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import type { Store } from '../store/store.ts';
import type { Runner } from './run.ts';
import { lettered } from './suggest.ts';
import { sentenceOf } from './task.ts';

/** Repairs; a run with the old pairs ends. `lookAtPair` brings a pair before the user's eyes. */
export function repair(store: Store, runner: Runner, lookAtPair: (index: number) => void, finding: Finding): void {
  const { state, dispatch } = store;
  try {
    switch (finding.repair) {
      case 'swap':
        runner.cancel();
        dispatch({ kind: 'targets-exchanged', indices: finding.pairs });
        break;
      case 'mirror_target': {
        const target = state.meshes[1];
        if (target !== null) {
          const events = mirroredTarget(target, landmarkFileOf(state));
          runner.cancel();
          dispatch(...events);
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
        lookAtPair(finding.pairs[0] ?? 0);
        break;
    }
  } catch (thrown) {
    dispatch({ kind: 'error', sentence: sentenceOf(thrown) });
  }
}
