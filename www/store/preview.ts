/** The preview of a map that is not made yet. */
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
