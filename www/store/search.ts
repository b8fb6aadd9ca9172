/** The search for landmarks: how it begins and ends, and the pairs that are taken of what it found. */
import type { AnswerPicture } from '../compute/match-messages.ts';
import type { Pair, Suggestion, WholePair } from '../landmarks.ts';
import { isSamePoint, isWhole, SIDES } from '../landmarks.ts';
import { pairLocked } from '../messages.ts';
import type { Candidate, MatchReport, Question } from '../report.ts';
import type { Event } from './events.ts';
import { withNewPairs, withSuggestions } from './pairs.ts';
import type { State } from './state.ts';

type Points = WholePair['points'];

/** Whether a search can begin. */
export function canSearch({ ready, meshes, job, matching }: State): boolean {
  return ready && meshes.every((file) => file !== null) && job.kind !== 'running' && job.kind !== 'busy' && matching?.kind !== 'searching';
}

/** A search of what is on the page begins. */
export function withSearch(state: State): State {
  return canSearch(state) ? { ...state, matching: { kind: 'searching', of: state.pairs, share: 0 }, error: null } : state;
}

/** A search goes on. */
export function withSearched(state: State, share: number): State {
  return state.matching?.kind === 'searching' ? { ...state, matching: { ...state.matching, share } } : state;
}

function arePoints({ points }: Pair, [source, target]: Points): boolean {
  return isSamePoint(points[0], source) && isSamePoint(points[1], target);
}

/** Whether two candidates have the same pairs; their maps may still be others, which go another way round the body. */
function haveSamePairs(a: Candidate, b: Candidate): boolean {
  const isSame = ([source, target]: Points, [s, t]: Points): boolean => isSamePoint(source, s) && isSamePoint(target, t);
  return a.pairs.length === b.pairs.length && a.pairs.every((pair) => b.pairs.some((other) => isSame(pair, other)));
}

/** Whether a pair has one of these points. */
function hasOne({ points }: Pair, found: Points): boolean {
  return SIDES.some((side) => isSamePoint(points[side], found[side]));
}

/** The pair on the page that becomes a found one: the same, a half one with one of its points, or one of the same place of the source. */
function becoming(pairs: readonly Pair[], found: Points): Pair | null {
  const same = pairs.find((pair) => arePoints(pair, found));
  if (same !== undefined) {
    return same;
  }
  const half = pairs.find((pair) => !isWhole(pair) && hasOne(pair, found));
  const other = half ?? pairs.find((pair) => isWhole(pair) && !pair.locked && isSamePoint(pair.points[0], found[0]));
  return other === undefined ? null : { ...other, points: found };
}

/** The pairs of a candidate in place of the present ones, which keep numbers, labels and locks where they become some of them. */
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

/** Places of the source that are to be marked, as rings with letters; after Z comes A again. */
function ringsAt(places: readonly number[]): Suggestion[] {
  return places.map((point, index) => ({ point, reason: 'far', letter: String.fromCharCode(65 + (index % 26)), partner: null }));
}

/** A search is over: the best pairs are taken, or places are shown where there are none. */
export function withFound(state: State, report: MatchReport, pictures: readonly AnswerPicture[]): State {
  if (state.matching?.kind !== 'searching') {
    return state;
  }
  const [best] = report.candidates;
  const found: State = { ...state, matching: { kind: 'found', report, pictures, isSettled: false } };
  if (best === undefined || report.verdict.kind === 'unknown') {
    return { ...found, suggestions: withSuggestions(state, 0, ringsAt(report.verdict.places)) };
  }
  const taken = withCandidate(found, best);
  // What was said meanwhile, of a file that was refused, is not for the search to take back.
  return { ...taken, error: taken.error ?? state.error };
}

/** The pairs of a candidate are taken, since the user chose it. */
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

/** The number of the candidate whose pairs are on the page, with whatever others, the one with the most; `null` where none is. */
export function takenCandidate({ matching, pairs }: Pick<State, 'matching' | 'pairs'>): number | null {
  const candidates = matching?.kind === 'found' ? matching.report.candidates : [];
  const isThere = (candidate: Candidate): boolean => candidate.pairs.every((points) => pairs.some((pair) => arePoints(pair, points)));
  const there = candidates.map((candidate) => (isThere(candidate) ? candidate.pairs.length : 0));
  const most = Math.max(0, ...there);
  return most === 0 ? null : there.indexOf(most);
}

/** Whether the pairs on the page are found ones that may be wrong, and nobody has settled that. */
export function isDoubtful(state: Pick<State, 'matching' | 'pairs'>): boolean {
  const { matching } = state;
  return (
    matching?.kind === 'found' && matching.report.verdict.kind === 'doubtful' && !matching.isSettled && takenCandidate(state) !== null
  );
}

/** The candidates whose pairs are other ones than those of the candidates before them, with their numbers. */
export function listed({ candidates }: MatchReport): readonly { readonly candidate: Candidate; readonly number: number }[] {
  return candidates
    .map((candidate, number) => ({ candidate, number }))
    .filter(({ candidate, number }) => !candidates.slice(0, number).some((earlier) => haveSamePairs(earlier, candidate)));
}

/**
 * What an answer to a question does: the pairs of its candidate are taken, and where both have the same ones, the place that was
 * asked about becomes one more.
 */
export function answered({ candidates }: MatchReport, { source, targets, rival }: Question, answer: 0 | 1): readonly Event[] {
  const [best, other] = [candidates[0], candidates[rival]];
  const taken: Event = { kind: 'candidate-taken', candidate: answer === 0 ? 0 : rival };
  return best === undefined || other === undefined || !haveSamePairs(best, other)
    ? [taken]
    : [taken, { kind: 'point-picked', side: 0, point: source }, { kind: 'point-picked', side: 1, point: targets[answer] }];
}
