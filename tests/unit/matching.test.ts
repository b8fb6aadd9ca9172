/** The search for landmarks: what happens to the pairs on the page, and what ends a search. */
import { beforeEach, describe, expect, test, vi } from 'vitest';
import { Finder } from '../../www/app/find.ts';
import type { MatchMessage, MatchRequest } from '../../www/compute/match-messages.ts';
import type { Pair } from '../../www/landmarks.ts';
import { SIDES } from '../../www/landmarks.ts';
import { stepAfter } from '../../www/panels/steps.ts';
import type { MatchReport } from '../../www/report.ts';
import { change } from '../../www/store/change.ts';
import type { Event } from '../../www/store/events.ts';
import { landmarkFileOf } from '../../www/store/landmark-file.ts';
import { ghostPairs, shownGhosts, shownPreview } from '../../www/store/preview.ts';
import { answered, isDoubtful, listed, takenCandidate } from '../../www/store/search.ts';
import { Store } from '../../www/store/store.ts';
import type { State } from '../../www/store/state.ts';
import { staleness } from '../../www/store/staleness.ts';
import { workOf } from '../../www/store/work.ts';
import { labelsOf, marksOf } from '../../www/viewer/pins.ts';
import { fakeWorkers } from './fake-worker.ts';
import { after, candidate, DEMO, DONE, FOUR, MATCH, mesh, pair, PICTURES, READY } from './fixtures.ts';

const SEARCH: Event = { kind: 'search-begun' };
const FOUND: Event = { kind: 'search-done', report: MATCH, pictures: PICTURES };
const REFUSED: Event = { kind: 'error', sentence: 'marks.json: There is no pair.' };
const TWO: State = { ...READY, pairs: FOUR.slice(0, 2) };
const take = (number: number): Event => ({ kind: 'candidate-taken', candidate: number });
/** A sure answer with these candidates. */
const sure = (...candidates: MatchReport['candidates']): Event => ({
  kind: 'search-done',
  report: { verdict: { kind: 'sure', sentence: 'Sure.', question: null, places: [] }, candidates },
  pictures: PICTURES,
});
/** The answer that the target is mirrored, with these candidates. */
const mirrored = (...candidates: MatchReport['candidates']): Event => ({
  kind: 'search-done',
  report: { verdict: { kind: 'mirrored', sentence: 'Mirrored.', question: null, places: [] }, candidates },
  pictures: PICTURES,
});
const pointsOf = ({ pairs }: State): Pair['points'][] => pairs.map(({ points }) => points);

describe('ghosts of a search', () => {
  const SEEN: Event = { kind: 'search-preview', places: new Float32Array(9), pairs: [[4, 14], [5, 15]] };
  const searched = after({ ...TWO, pairs: [...TWO.pairs, pair(7, null, 15)] }, SEARCH, SEEN);

  test('have the next numbers, or that of the half pair which they would complete', () => {
    expect(ghostPairs(searched)).toEqual([{ number: 8, points: [4, 14] }, { number: 7, points: [5, 15] }]);
  });

  test('are not part of the work', () => {
    expect(workOf(searched)).toEqual(workOf({ ...TWO, pairs: [...TWO.pairs, pair(7, null, 15)] }));
    expect(landmarkFileOf(searched).pairs).toEqual([[0, 10], [1, 11]]);
    expect(searched.history).toBe(TWO.history);
  });

  test('are seen in both views as pins with a question mark, where pins are shown', () => {
    for (const side of SIDES) {
      const marks = JSON.parse(marksOf(searched, side)) as unknown[];
      expect(marks).toHaveLength(5);
      expect(marks.slice(3)).toEqual([
        { point: [4, 14][side], colour: 7, stand: 'ghost', cone: null },
        { point: [5, 15][side], colour: 6, stand: 'ghost', cone: null },
      ]);
      expect(labelsOf(searched, side).map(({ text }) => text)).toEqual(['1', '2', '7', '8?', '7?']);
    }
    expect(ghostPairs(after(searched, { kind: 'style', style: { markers: false } }))).toEqual([]);
  });

  test.each<[string, Event]>([
    ['its answer', FOUND],
    ['its end', { kind: 'search-closed' }],
    ['another mesh', { kind: 'swap-meshes' }],
    ['another point', { kind: 'point-picked', side: 0, point: 9 }],
    ['a run', { kind: 'run-started' }],
  ])('go with %s', (_, event) => {
    expect(shownGhosts(after(searched, event))).toEqual([]);
  });
});

describe('found pairs', () => {
  test('come behind the whole pairs that were given, which keep ids, numbers, names and locks', () => {
    const given = [{ ...pair(3, 0, 10, 'nose'), locked: true }, pair(7, 1, 11)];
    const found = after({ ...READY, pairs: given, nextId: 8 }, SEARCH, FOUND);
    expect(found.pairs.slice(0, 2)).toEqual(given);
    expect(found.pairs.slice(2)).toEqual([
      { id: 8, number: 8, points: [4, 14], label: 'end 3', locked: false },
      { id: 9, number: 9, points: [5, 15], label: 'end 4', locked: false },
    ]);
  });

  test('complete the half pairs that they meet; the other half pairs go, and that is said', () => {
    const halves = [pair(5, 4, null, 'tail'), pair(6, null, 15), pair(7, 9, null), { ...pair(8, null, 19), locked: true }];
    const before: State = { ...TWO, pairs: [...TWO.pairs, ...halves], nextId: 9 };
    const found = after(before, SEARCH, FOUND);
    expect(found.pairs).toEqual([...TWO.pairs, pair(5, 4, 14, 'tail'), pair(6, 5, 15), halves[3]]);
    expect(found.toast).toEqual({ sentence: '2 landmark pairs found. 1 other pair removed.', undo: true });
    expect(after(found, { kind: 'undo' }).pairs).toBe(before.pairs);
  });

  test('of a demo are its own: its landmarks are held, and it stays a demo', () => {
    const demo = after({ ...READY, demo: DEMO, groundTruth: 'the same numbers' }, SEARCH, sure(candidate([0, 10], [1, 11], [2, 12], [3, 13], [4, 14])));
    expect(demo.pairs.slice(0, 4)).toEqual(FOUR);
    expect(demo.pairs).toHaveLength(5);
    expect(demo).toMatchObject({ demo: DEMO, groundTruth: 'the same numbers' });
  });

  test('that are there already make no step, and how sure they are is told', () => {
    const begun = after(READY, SEARCH);
    const found = after(begun, sure(candidate([3, 13], [0, 10], [1, 11], [2, 12])));
    expect(found.pairs).toBe(READY.pairs);
    expect(found.history).toBe(READY.history);
    expect(found.matching).toMatchObject({ kind: 'found' });
    expect(stepAfter(found, begun)).toBe('landmarks');
  });

  test('leave a sentence that came while they were looked for', () => {
    const found = after(TWO, SEARCH, REFUSED, FOUND);
    expect(found.pairs).toHaveLength(4);
    expect(found.error).toBe('marks.json: There is no pair.');
    // A user who takes another answer has read the error.
    expect(after(found, { kind: 'undo' }, take(0)).error).toBeNull();
  });

  test('are shown in their list from every step', () => {
    const begun = after({ ...TWO, ui: { ...TWO.ui, step: 'meshes' } }, SEARCH);
    expect(stepAfter(after(begun, FOUND), begun)).toBe('landmarks');
  });

  test('that nobody could tell leave the pairs, and places to mark are ringed', () => {
    const verdict = { kind: 'unknown' as const, sentence: 'Mark three places.', question: null, places: [7, 8, 9] };
    const found = after(TWO, SEARCH, { kind: 'search-done', report: { ...MATCH, verdict }, pictures: PICTURES });
    expect(found.pairs).toBe(TWO.pairs);
    expect(found.suggestions[0].map(({ point, letter }) => [letter, point])).toEqual([['A', 7], ['B', 8], ['C', 9]]);
    expect(found.suggestions[1]).toEqual([]);
    expect(takenCandidate(found)).toBeNull();
    // The best of the bad answers can still be taken.
    expect(takenCandidate(after(found, take(0)))).toBe(0);
  });

  test('come only from a search that is still under way', () => {
    expect(after(TWO, FOUND)).toBe(TWO);
    expect(after(TWO, SEARCH, { kind: 'search-closed' }, FOUND).pairs).toBe(TWO.pairs);
  });
});

describe('an answer', () => {
  const found = after(TWO, SEARCH, FOUND);

  test('goes as one step, and its list works after that', () => {
    const undone = after(found, { kind: 'undo' });
    expect(undone.pairs).toBe(TWO.pairs);
    expect(undone.matching).toBe(found.matching);
    expect(takenCandidate(undone)).toBeNull();
    const taken = after(undone, take(1));
    expect(pointsOf(taken)).toEqual([[0, 10], [1, 11], [4, 15], [5, 14], [6, 16]]);
    expect(takenCandidate(taken)).toBe(1);
    expect(takenCandidate(after(found, { kind: 'undo' }, { kind: 'redo' }))).toBe(0);
  });

  test('that is taken again changes nothing of the work', () => {
    const again = after(found, take(0));
    expect(again.pairs).toBe(found.pairs);
    expect(again.history).toBe(found.history);
    expect(after(again, take(0))).toBe(again);
    expect(after(again, take(7))).toBe(again);
  });

  test('that is another one moves the targets of the same places', () => {
    const other = after(found, take(1));
    expect(other.pairs.slice(0, 4).map(({ id, number }) => [id, number])).toEqual(found.pairs.map(({ id, number }) => [id, number]));
    expect(other.pairs[2]?.label).toBe('end 3');
    expect(other.toast).toEqual({ sentence: '3 landmark pairs placed as in the chosen answer.', undo: true });
    const back = after(other, take(0));
    expect(pointsOf(back)).toEqual(pointsOf(found));
    expect(back.toast?.sentence).toBe('2 landmark pairs placed as in the chosen answer. 1 other pair removed.');
    // The map of the first answer is up to date again.
    expect(staleness({ ...back, result: DONE.result && { ...DONE.result, inputs: found } })).toBeNull();
  });

  test('does not take a locked pair away', () => {
    const locked = after(found, { kind: 'pair-locked', id: 5, locked: true }, take(1));
    expect(pointsOf(locked)).toEqual(pointsOf(found));
    expect(locked.error).toContain('3');
    expect(locked.matching).toBe(found.matching);
  });

  test('that is doubtful stays so until the user has chosen', () => {
    expect(isDoubtful(found)).toBe(true);
    expect(isDoubtful(after(found, { kind: 'undo' }))).toBe(false);
    expect(isDoubtful(after(found, take(0)))).toBe(false);
    expect(isDoubtful(after(found, { kind: 'run-started' }))).toBe(true);
    expect(isDoubtful(after(TWO, SEARCH, sure(candidate([0, 10], [1, 11], [4, 14], [5, 15]))))).toBe(false);
  });

  test('onto a mirrored target leaves the pairs as they are, and is over when the target is mirrored', () => {
    const told = after(TWO, SEARCH, mirrored(candidate([0, 10], [1, 11], [4, 14], [5, 15])));
    expect([told.matching?.kind, told.pairs]).toEqual(['found', TWO.pairs]);
    const file = told.meshes[1];
    if (file === null) {
      throw new Error('the target is missing');
    }
    expect(after(told, { kind: 'mirrored', file: { ...file }, points: [10, 11] }).matching).toBeNull();
  });

  test('to the question settles the doubt', () => {
    const { question } = MATCH.verdict;
    if (question === null) {
      throw new Error('the match asks a question');
    }
    const first = change(found, answered(MATCH, question, 0));
    expect([takenCandidate(first), isDoubtful(first), first.pairs]).toEqual([0, false, found.pairs]);
    const second = change(found, answered(MATCH, question, 1));
    expect([takenCandidate(second), isDoubtful(second)]).toEqual([1, false]);
  });

  test('to a question about another way round the body is one more pair, in one step', () => {
    const [best = candidate()] = MATCH.candidates;
    const question = { source: 6, targets: [16, 17] as [number, number], rival: 1 };
    const report: MatchReport = { verdict: { ...MATCH.verdict, question }, candidates: [best, { ...best, pairs: [...best.pairs].reverse() }] };
    expect(listed(report).map(({ number }) => number)).toEqual([0]);
    const asked = after(TWO, SEARCH, { kind: 'search-done', report, pictures: PICTURES });
    const settled = change(asked, answered(report, question, 1));
    expect(pointsOf(settled)).toEqual([...pointsOf(asked), [6, 17]]);
    expect([isDoubtful(settled), takenCandidate(settled)]).toEqual([false, 0]);
    expect(after(settled, { kind: 'undo' }).pairs).toBe(asked.pairs);
  });

  test('is listed once', () => {
    expect(listed(MATCH).map(({ number }) => number)).toEqual([0, 1]);
  });

  test('is known beside pairs that came later', () => {
    const more = after(found, { kind: 'point-picked', side: 0, point: 8 }, { kind: 'point-picked', side: 1, point: 18 });
    expect(takenCandidate(more)).toBe(0);
  });

  test('goes with its meshes, also when they change their places', () => {
    expect(after(found, { kind: 'mesh', side: 1, file: mesh('cow.off') }).matching).toBeNull();
    expect(after(found, { kind: 'swap-meshes' }).matching).toBeNull();
    expect(after(found, { kind: 'pairs-cleared' }).matching).toBe(found.matching);
  });
});

describe('a search', () => {
  const searching = after(TWO, SEARCH);

  test('takes two meshes and a page at rest', () => {
    const begun = (state: State): boolean => after(state, SEARCH).matching !== null;
    expect(begun(TWO)).toBe(true);
    expect(begun({ ...TWO, pairs: [] })).toBe(true);
    expect(begun({ ...TWO, meshes: [TWO.meshes[0], null] })).toBe(false);
    expect(begun({ ...TWO, ready: false })).toBe(false);
    expect(begun(after(TWO, { kind: 'run-started' }))).toBe(false);
    expect(begun(after(TWO, { kind: 'task-begun', task: { sentence: 'Reading…' } }))).toBe(false);
    expect(after(searching, SEARCH)).toBe(searching);
  });

  test.each<[string, Event, 'ends' | 'goes on']>([
    ['a mesh', { kind: 'mesh', side: 0, file: mesh('cow.off') }, 'ends'],
    ['an exchange of the meshes', { kind: 'swap-meshes' }, 'ends'],
    ['a point', { kind: 'point-picked', side: 0, point: 9 }, 'ends'],
    ['a moved point', { kind: 'point-moved', id: 1, side: 0, point: 9, gesture: 1 }, 'ends'],
    ['a deleted pair', { kind: 'pair-deleted', id: 1 }, 'ends'],
    ['a run', { kind: 'run-started' }, 'ends'],
    ['a name', { kind: 'pair-labelled', id: 1, label: 'nose' }, 'goes on'],
    ['a lock', { kind: 'pair-locked', id: 1, locked: true }, 'goes on'],
    ['another order', { kind: 'pair-moved', id: 2, to: 0 }, 'goes on'],
    ['an option', { kind: 'options', options: { method: 'thesis' } }, 'goes on'],
    ['a step of the page', { kind: 'ui', ui: { step: 'map' } }, 'goes on'],
  ])('after %s', (_, event, what) => {
    expect(after(searching, event).matching === null ? 'ends' : 'goes on').toBe(what);
  });
});

const FakeWorker = fakeWorkers<MatchMessage>();
type FakeWorker = InstanceType<typeof FakeWorker>;

describe('the worker of a search', () => {
  const CORE = {} as WebAssembly.Module;
  let store: Store;
  let finder: Finder;

  function started(): FakeWorker {
    finder.start();
    const worker = FakeWorker.made.at(-1);
    if (worker === undefined) {
      throw new Error('no worker was made');
    }
    return worker;
  }

  beforeEach(() => {
    FakeWorker.made = [];
    vi.stubGlobal('Worker', FakeWorker);
    vi.spyOn(console, 'error').mockReturnValue();
    store = new Store();
    finder = new Finder(store, () => CORE);
    store.dispatch(
      { kind: 'ready', demos: [] },
      { kind: 'mesh', side: 0, file: mesh('cat.off') },
      { kind: 'mesh', side: 1, file: mesh('lion.off') },
    );
    store.dispatch({ kind: 'landmarks', file: { pairs: [[0, 10]], labels: ['nose'] } });
    store.dispatch({ kind: 'point-picked', side: 0, point: 3 });
  });

  test('gets the meshes and the whole pairs of the page', () => {
    const request = started().posted[0] as MatchRequest;
    const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
    expect([text(request.source), text(request.target)]).toEqual(['cat.off', 'lion.off']);
    expect(JSON.parse(request.landmarks)).toMatchObject({ pairs: [[0, 10]], labels: ['nose'] });
    expect(request.module).toBe(CORE);
  });

  test('brings its share, the best map so far and its answer into the state, and ends', () => {
    const worker = started();
    worker.says({ kind: 'progress', share: 0.5 });
    expect(store.state.matching).toMatchObject({ kind: 'searching', share: 0.5 });
    expect(shownPreview(store.state)).toBeNull();
    const places = new Float32Array(9);
    worker.says({ kind: 'preview', places, pairs: [[3, 13], [4, 14]] });
    expect(shownPreview(store.state)).toBe(places);
    expect(shownGhosts(store.state)).toEqual([[3, 13], [4, 14]]);
    worker.says({ kind: 'done', report: JSON.stringify(MATCH), pictures: PICTURES });
    expect(worker.ended).toBe(true);
    expect(pointsOf(store.state)).toEqual([[0, 10], [1, 11], [4, 14], [5, 15]]);
    expect(store.state.matching).toEqual({ kind: 'found', report: MATCH, pictures: PICTURES, isSettled: false });
    expect(shownPreview(store.state)).toBeNull();
    expect(shownGhosts(store.state)).toEqual([]);
  });

  test.each<[string, Event]>([
    ['that is given up', { kind: 'search-closed' }],
    ['about other pairs', { kind: 'pairs-cleared' }],
    ['about other meshes', { kind: 'swap-meshes' }],
    ['when a run begins', { kind: 'run-started' }],
  ])('ends with a search %s, and nothing more is heard of it', (_, event) => {
    const worker = started();
    store.dispatch(event);
    expect(worker.ended).toBe(true);
    const { state } = store;
    worker.says({ kind: 'done', report: JSON.stringify(MATCH), pictures: PICTURES });
    worker.says({ kind: 'failed', failure: { code: 'worker', message: 'it stopped' } });
    expect(store.state).toBe(state);
  });

  test('that was given up does not answer for the next one', () => {
    const first = started();
    store.dispatch({ kind: 'search-closed' });
    const second = started();
    expect(second).not.toBe(first);
    first.says({ kind: 'done', report: JSON.stringify(MATCH), pictures: PICTURES });
    expect(store.state.matching).toMatchObject({ kind: 'searching' });
    second.says({ kind: 'done', report: JSON.stringify(MATCH), pictures: PICTURES });
    expect(store.state.matching).toMatchObject({ kind: 'found' });
  });

  test('that fails says why and leaves the pairs', () => {
    const { pairs } = store.state;
    started().says({ kind: 'failed', failure: { code: 'matching', message: 'no limb was found' } });
    expect(store.state).toMatchObject({ matching: null, error: 'No limb was found.' });
    expect(store.state.pairs).toBe(pairs);
  });

  test('is one at a time, and none without the core', () => {
    started();
    finder.start();
    expect(FakeWorker.made).toHaveLength(1);
    new Finder(store, () => null).start();
    expect(FakeWorker.made).toHaveLength(1);
  });
});
