/** The preview of a map that is not made yet, and of landmarks that are not found yet. */
import type { FoundPairs } from '../compute/match-messages.ts';
import type { WholePair } from '../landmarks.ts';
import { isWhole } from '../landmarks.ts';
import { numberAfter } from './pairs.ts';
import { hasOne } from './search.ts';
import { shownResult } from './staleness.ts';
import type { State } from './state.ts';

/**
 * The preview that the page shows: of the run that makes a map of the meshes on the page, or of the search for their landmarks where they
 * have no map yet; for each vertex of the source its place on the target. `null` for none.
 */
export function shownPreview(state: State): Float32Array | null {
  const { job, meshes, matching } = state;
  if (job.kind === 'running') {
    return job.inputs.meshes[0] === meshes[0] && job.inputs.meshes[1] === meshes[1] ? job.preview : null;
  }
  return matching?.kind === 'searching' && shownResult(state) === null ? matching.preview : null;
}

const NONE: FoundPairs = [];

/** The best pairs that a search has found so far, where the views show pins. They are no landmarks of the page. */
export function shownGhosts({ matching, ui }: Pick<State, 'matching' | 'ui'>): FoundPairs {
  return matching?.kind === 'searching' && ui.style.markers ? matching.ghosts : NONE;
}

/** The same pairs with their numbers: that of the half pair which a ghost would complete, or the next ones. */
export function ghostPairs(state: Pick<State, 'matching' | 'ui' | 'pairs'>): readonly Pick<WholePair, 'number' | 'points'>[] {
  let next = numberAfter(state.pairs);
  return shownGhosts(state).map((points) => {
    const half = state.pairs.find((pair) => !isWhole(pair) && hasOne(pair, points));
    return { number: half?.number ?? next++, points };
  });
}
