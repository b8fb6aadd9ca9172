/** The search for landmarks: how it begins and ends, and how the pairs that it has found are taken. */
import type { AnswerPicture } from '../compute/match-messages.ts';
import type { Pair, Suggestion, WholePair } from '../landmarks.ts';
import { isSamePoint, isWhole, SIDES } from '../landmarks.ts';
import { pairLocked } from '../messages.ts';
import type { Candidate, MatchReport, Question } from '../report.ts';
import type { Event } from './events.ts';
import type { Searching } from './matching.ts';
import { withNewPairs, withSuggestions } from './pairs.ts';
import type { State } from './state.ts';

type Points = WholePair['points'];

/** Whether a search can begin. */
export function canSearch({ ready, meshes, job, matching }: State): boolean {
  return ready && meshes.every((file) => file !== null) && job.kind !== 'running' && job.kind !== 'busy' && matching?.kind !== 'searching';
}

/** Begins a search for what is on the page. */
export function withSearch(state: State): State {
  const searching: Searching = { kind: 'searching', of: state.pairs, share: 0, preview: null, ghosts: [] };
  return canSearch(state) ? { ...state, matching: searching, error: null } : state;
}

/** Stores how far the search has come. */
export function withSearched(state: State, news: Partial<Pick<Searching, 'share' | 'preview' | 'ghosts'>>): State {
  return state.matching?.kind === 'searching' ? { ...state, matching: { ...state.matching, ...news } } : state;
}

function arePoints({ points }: Pair, [source, target]: Points): boolean {
  return isSamePoint(points[0], source) && isSamePoint(points[1], target);
}

/** Whether two candidates have the same pairs. Their maps may still go different ways round the body. */
function haveSamePairs(a: Candidate, b: Candidate): boolean {
  const isSame = ([source, target]: Points, [s, t]: Points): boolean => isSamePoint(source, s) && isSamePoint(target, t);
  return a.pairs.length === b.pairs.length && a.pairs.every((pair) => b.pairs.some((other) => isSame(pair, other)));
}

/** Whether a pair has one of these points. */
export function hasOne({ points }: Pair, found: Points): boolean {
  return SIDES.some((side) => isSamePoint(points[side], found[side]));
}

/**
 * The pair on the page that becomes a found one: a pair with the same points, else a half pair with one of them, else an unlocked pair with
 * the same place on the source; `null` for none.
 */
function becoming(pairs: readonly Pair[], found: Points): Pair | null {
  const same = pairs.find((pair) => arePoints(pair, found));
  if (same !== undefined) {
    return same;
  }
  const half = pairs.find((pair) => !isWhole(pair) && hasOne(pair, found));
  const other = half ?? pairs.find((pair) => isWhole(pair) && !pair.locked && isSamePoint(pair.points[0], found[0]));
  return other === undefined ? null : { ...other, points: found };
}

/** Replaces the present pairs by those of a candidate. A pair that becomes one of these keeps its number, label and lock. */
function withCandidate(state: State, { pairs, labels }: Candidate): State {
  const become = pairs.map((points) => becoming(state.pairs, points));
  const kept = become.filter((pair) => pair !== null);
  const ids = new Set(kept.map(({ id }) => id));
  const locked = state.pairs.filter((pair) => pair.locked && !ids.has(pair.id));
  const held = locked.find(isWhole);
  if (held !== undefined) {
    return { ...state, error: pairLocked(held.number) };
  }
  const stay = locked.filter((pair) => !pairs.some((points) => hasOne(pair, points)));
  const present = [...kept, ...stay];
  if (kept.length === pairs.length && present.length === state.pairs.length && present.every((pair) => state.pairs.includes(pair))) {
    return state;
  }
  const made = pairs.flatMap((points, index) => (become[index] === null ? [{ points, label: labels[index] ?? '' }] : []));
  return withNewPairs({ ...state, pairs: present, error: null }, made);
}

/** Places of the source that are marked as rings with letters; after Z the letters begin again at A. */
function ringsAt(places: readonly number[]): Suggestion[] {
  return places.map((point, index) => ({ point, reason: 'far', letter: String.fromCharCode(65 + (index % 26)), partner: null }));
}

/** Ends a search: takes the best pairs, or marks places where there are none. */
export function withFound(state: State, report: MatchReport, pictures: readonly AnswerPicture[]): State {
  if (state.matching?.kind !== 'searching') {
    return state;
  }
  const [best] = report.candidates;
  const found: State = { ...state, matching: { kind: 'found', report, pictures, isSettled: false } };
  if (report.verdict.kind === 'mirrored') {
    return found;
  }
  if (best === undefined || report.verdict.kind === 'unknown') {
    return { ...found, suggestions: withSuggestions(state, 0, ringsAt(report.verdict.places)) };
  }
  const taken = withCandidate(found, best);
  // An error that was shown during the search, such as about a refused file, stays.
  return { ...taken, error: taken.error ?? state.error };
}

/** Takes the pairs of a candidate that the user has chosen. */
export function withTaken(state: State, number: number): State {
  const { matching } = state;
  const candidate = matching?.kind === 'found' ? matching.report.candidates[number] : undefined;
  if (matching?.kind !== 'found' || candidate === undefined) {
    return state;
  }
  const taken = withCandidate(state, candidate);
  const isRefused = taken !== state && taken.pairs === state.pairs;
  return isRefused || matching.isSettled ? taken : { ...taken, matching: { ...matching, isSettled: true } };
}

/**
 * The number of the candidate whose pairs are all on the page, among whatever others; of several the one with the most pairs; `null` for
 * none.
 */
export function takenCandidate({ matching, pairs }: Pick<State, 'matching' | 'pairs'>): number | null {
  const candidates = matching?.kind === 'found' ? matching.report.candidates : [];
  const isThere = (candidate: Candidate): boolean => candidate.pairs.every((points) => pairs.some((pair) => arePoints(pair, points)));
  const there = candidates.map((candidate) => (isThere(candidate) ? candidate.pairs.length : 0));
  const most = Math.max(0, ...there);
  return most === 0 ? null : there.indexOf(most);
}

/** Whether the pairs on the page were found, may be wrong, and the user has not settled that. */
export function isDoubtful(state: Pick<State, 'matching' | 'pairs'>): boolean {
  const { matching } = state;
  return (
    matching?.kind === 'found' && matching.report.verdict.kind === 'doubtful' && !matching.isSettled && takenCandidate(state) !== null
  );
}

/** The candidates whose pairs differ from those of all candidates before them, with their numbers. */
export function listed({ candidates }: MatchReport): readonly { readonly candidate: Candidate; readonly number: number }[] {
  return candidates
    .map((candidate, number) => ({ candidate, number }))
    .filter(({ candidate, number }) => !candidates.slice(0, number).some((earlier) => haveSamePairs(earlier, candidate)));
}

/**
 * The events of an answer to a question: the pairs of its candidate are taken; where both candidates have the same pairs, the place that
 * was asked about becomes a further pair.
 */
export function answered({ candidates }: MatchReport, { source, targets, rival }: Question, answer: 0 | 1): readonly Event[] {
  const [best, other] = [candidates[0], candidates[rival]];
  const taken: Event = { kind: 'candidate-taken', candidate: answer === 0 ? 0 : rival };
  return best === undefined || other === undefined || !haveSamePairs(best, other)
    ? [taken]
    : [taken, { kind: 'point-picked', side: 0, point: source }, { kind: 'point-picked', side: 1, point: targets[answer] }];
}
