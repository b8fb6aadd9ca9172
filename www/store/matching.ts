/** The search for landmarks, or its answer. */
import type { AnswerPicture, FoundPairs } from '../compute/match-messages.ts';
import type { Pair } from '../landmarks.ts';
import type { MatchReport } from '../report.ts';
import type { Work } from './work.ts';

/** A search that goes on. The page can be used meanwhile; another mesh or another point of a pair ends it. */
export interface Searching {
  readonly kind: 'searching';
  /** The pairs on the page when it began; those with both points are held. */
  readonly of: readonly Pair[];
  /** The share that is done, from 0 to 1. */
  readonly share: number;
  /** The coarse map of the best pairs so far: for each vertex of the source its place on the target; `null` before the first. */
  readonly preview: Float32Array | null;
  /** The best pairs so far but for those on the page. They are no landmarks yet: the views show them until the search ends. */
  readonly ghosts: FoundPairs;
}

/** The answer of a search for the meshes on the page. */
export interface Found {
  readonly kind: 'found';
  readonly report: MatchReport;
  /** A picture of the coarse map of each candidate. */
  readonly pictures: readonly AnswerPicture[];
  /** Whether the user has chosen among the candidates, which settles the doubt. */
  readonly isSettled: boolean;
}

export type Matching = Searching | Found;

/** Whether these are the same pairs with the same points; their labels, locks and order may differ. */
function haveSamePoints(pairs: readonly Pair[], others: readonly Pair[]): boolean {
  const points = new Map(others.map((pair) => [pair.id, pair.points]));
  return pairs.length === others.length && pairs.every((pair) => points.get(pair.id) === pair.points);
}

/** The search or answer after the work has changed: a search ends where its points change, an answer where its meshes change. */
export function stillMatching(matching: Matching | null, state: Work, before: Work): Matching | null {
  const isOther =
    state.meshes !== before.meshes || (matching?.kind === 'searching' && !haveSamePoints(state.pairs, matching.of));
  return isOther ? null : matching;
}
