/** Carries out the repair that a finding about the landmarks suggests. */
import { mirroredEvent, mirrorQuestion } from '../files.ts';
import type { FileReader } from '../reading/reader.ts';
import type { Doubt } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { Runner } from './run.ts';
import { lettered } from './suggest.ts';
import { perform } from './task.ts';

/** What a repair acts on. */
export interface RepairTools {
  readonly runner: Runner;
  readonly reader: FileReader;
  /** Turns the views to a pair. */
  readonly lookAtPair: (id: number) => void;
}

/** Replaces the target by its mirror image, with its points; a run with the old points ends. */
export async function mirror(store: Store, { runner, reader }: Pick<RepairTools, 'runner' | 'reader'>): Promise<void> {
  const { pairs, meshes } = store.state;
  const target = meshes[1];
  if (target === null) {
    return;
  }
  runner.cancel();
  await perform(
    store,
    `Mirroring ${target.name}…`,
    (signal) => reader.ask(mirrorQuestion(target, pairs), signal),
    (mirrored) => {
      // Points that were placed since lie on the mesh as it was, so the image is dropped.
      if (store.state.meshes[1] === target && store.state.pairs === pairs) {
        store.dispatch(mirroredEvent(mirrored, pairs));
      }
    },
  );
}

/** Carries out the repair of a finding; a run with the old pairs ends. */
export function repair(store: Store, tools: RepairTools, finding: Doubt): void {
  const { dispatch } = store;
  switch (finding.repair) {
    case 'swap':
      tools.runner.cancel();
      dispatch({ kind: 'targets-exchanged', ids: finding.ids });
      break;
    case 'mirror_target':
      void mirror(store, tools);
      break;
    case 'mark':
      if (finding.side !== null) {
        const ends = finding.vertices.map((point) => ({ point, reason: 'tip' as const, partner: null }));
        dispatch({ kind: 'suggested', side: finding.side, suggestions: lettered(ends) });
      }
      break;
    case 'check':
      if (finding.ids[0] !== undefined) {
        dispatch({ kind: 'pair-selected', id: finding.ids[0] });
        tools.lookAtPair(finding.ids[0]);
      }
      break;
  }
}
