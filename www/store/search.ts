/** The search for landmarks: how it begins and ends, and the pairs that are taken of what it found. */
import type { Suggestion } from '../landmarks.ts';
import { isSamePoint } from '../landmarks.ts';
import type { Candidate, MatchReport } from '../report.ts';
import { withNewPairs, withSuggestions } from './pairs.ts';
import type { State } from './state.ts';

/** Whether a search can begin. */
export function canSearch({ ready, meshes, job, matching }: State): boolean {
  return ready && meshes.every((file) => file !== null) && job.kind !== 'running' && job.kind !== 'busy' && matching?.kind !== 'searching';
}

/** A search of what is on the page begins. */
export function withSearch(state: State): State {
  const { meshes, pairs } = state;
  return canSearch(state) ? { ...state, matching: { kind: 'searching', of: { meshes, pairs }, share: 0 }, error: null } : state;
}

/** A search goes on. */
export function withSearched(state: State, share: number): State {
  return state.matching?.kind === 'searching' ? { ...state, matching: { ...state.matching, share } } : state;
}

/** The pairs of a candidate in place of the present ones; those that it shares with them stay as they are. */
function withCandidate(state: State, { pairs, labels }: Candidate): State {
  const present = pairs.map(
    ([source, target]) =>
      state.pairs.find(({ points }) => isSamePoint(points[0], source) && isSamePoint(points[1], target)) ?? null,
  );
  const made = pairs.flatMap((points, index) => (present[index] === null ? [{ points, label: labels[index] ?? '' }] : []));
  const kept = present.filter((pair) => pair !== null);
  return withNewPairs({ ...state, pairs: kept, groundTruth: null }, made);
}

/** Places of the source that are to be marked, as rings. */
function ringsAt(places: readonly number[]): Suggestion[] {
  return places.map((point, index) => ({ point, reason: 'far', letter: String.fromCharCode(65 + index), partner: null }));
}

/** A search is over: the best pairs are taken, or places are shown where there are none. */
export function withFound(state: State, report: MatchReport): State {
  if (state.matching?.kind !== 'searching') {
    return state;
  }
  const [best] = report.candidates;
  const isTaken = best !== undefined && report.verdict.kind !== 'unknown';
  const suggestions = isTaken ? state.suggestions : withSuggestions(state, 0, ringsAt(report.verdict.places));
  const found: State = { ...state, matching: { kind: 'found', report, taken: isTaken ? 0 : null }, suggestions };
  return isTaken ? withCandidate(found, best) : found;
}

/** The pairs of another candidate are taken. */
export function withTaken(state: State, number: number): State {
  const { matching } = state;
  const candidate = matching?.kind === 'found' ? matching.report.candidates[number] : undefined;
  if (matching?.kind !== 'found' || candidate === undefined) {
    return state;
  }
  return withCandidate({ ...state, matching: { ...matching, taken: number }, error: null }, candidate);
}
