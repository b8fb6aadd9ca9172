/** Landmarks that the program looks for or has found. */
import type { MatchReport } from '../report.ts';
import type { Work } from './work.ts';

/** A search under way. The page can be used meanwhile; another mesh or another pair ends it. */
export interface Searching {
  readonly kind: 'searching';
  /** What it is about. */
  readonly of: Pick<Work, 'meshes' | 'pairs'>;
  /** Share that is done, 0 to 1. */
  readonly share: number;
}

/** What a search has found for the meshes on the page. */
export interface Found {
  readonly kind: 'found';
  readonly report: MatchReport;
  /** The number of the candidate whose pairs were taken last; `null` where there is none. */
  readonly taken: number | null;
}

export type Matching = Searching | Found;

/** What is known of landmarks that were searched, after other work has come: a search is about what it began with, an answer about its meshes. */
export function stillMatching(matching: Matching | null, state: Work, before: Work): Matching | null {
  const isOther = state.meshes !== before.meshes || (matching?.kind === 'searching' && state.pairs !== matching.of.pairs);
  return isOther ? null : matching;
}
