/** Marks places of a mesh that are worth a landmark. */
import type { Side, Suggestion } from '../landmarks.ts';
import { SENTENCES } from '../messages.ts';
import type { FileReader } from '../reading/reader.ts';
import { pointsOf } from '../store/points.ts';
import type { Store } from '../store/store.ts';
import { perform } from './task.ts';

/** A suggestion as the core gives it; `partner` is an index into the list of suggestions. */
interface Found {
  readonly point: number;
  readonly reason: Suggestion['reason'];
  readonly partner: number | null;
}

/** Suggestions named by letters in their order; after Z the letters begin again at A. */
export function lettered(found: readonly Found[]): Suggestion[] {
  const letter = (index: number): string => String.fromCharCode(65 + (index % 26));
  return found.map(({ point, reason, partner }, index) => ({
    point,
    reason,
    letter: letter(index),
    partner: partner === null ? null : letter(partner),
  }));
}

/** Marks places of one mesh, away from the landmarks that there are. */
export async function suggest(store: Store, reader: FileReader, side: Side): Promise<void> {
  const { job, meshes } = store.state;
  const file = meshes[side];
  // Suggestions do not interrupt the reading of a mesh.
  if (file === null || job.kind === 'running' || job.kind === 'busy') {
    return;
  }
  store.dispatch({ kind: 'error-closed' });
  await perform(
    store,
    'Looking for places that are worth a landmark…',
    (signal) => {
      const marked = JSON.stringify(pointsOf(store.state, side).filter((point) => point !== null));
      return reader.ask({ kind: 'suggest', mesh: file.mesh.packed(), marked }, signal);
    },
    (json) => {
      if (file !== store.state.meshes[side]) {
        return;
      }
      const suggestions = lettered(JSON.parse(json) as Found[]);
      store.dispatch({ kind: 'suggested', side, suggestions });
      if (suggestions.length === 0) {
        store.dispatch({ kind: 'error', sentence: SENTENCES.nothingToSuggest });
      }
    },
  );
}
