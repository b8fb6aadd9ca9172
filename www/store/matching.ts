/** Landmarks that the program looks for or has found. */
import type { AnswerPicture } from '../compute/match-messages.ts';
import type { Pair } from '../landmarks.ts';
import type { MatchReport } from '../report.ts';
import type { Work } from './work.ts';

/** A search under way. The page can be used meanwhile; another mesh or another point of a pair ends it. */
export interface Searching {
  readonly kind: 'searching';
  /** The pairs that it began with; the whole ones are held. */
  readonly of: readonly Pair[];
  /** Share that is done, 0 to 1. */
  readonly share: number;
}

/** What a search has found for the meshes on the page. */
export interface Found {
  readonly kind: 'found';
  readonly report: MatchReport;
  /** What the coarse map of each candidate looks like. */
  readonly pictures: readonly AnswerPicture[];
  /** Whether the user has chosen among the candidates, which settles a doubt. */
  readonly isSettled: boolean;
}

export type Matching = Searching | Found;

/** Whether these are the same pairs with the same points; labels, locks and the order may be others. */
function haveSamePoints(pairs: readonly Pair[], others: readonly Pair[]): boolean {
  const points = new Map(others.map((pair) => [pair.id, pair.points]));
  return pairs.length === others.length && pairs.every((pair) => points.get(pair.id) === pair.points);
}

/** What is known of landmarks after other work has come: a search is about the points it began with, an answer about its meshes. */
export function stillMatching(matching: Matching | null, state: Work, before: Work): Matching | null {
  const isOther =
    state.meshes !== before.meshes || (matching?.kind === 'searching' && !haveSamePoints(state.pairs, matching.of));
  return isOther ? null : matching;
}
