/** When the last map no longer belongs to what is on the page, and the sentence about it. */
import { describe, expect, test } from 'vitest';
import { staleSentence } from '../../www/messages.ts';
import type { RunOptions } from '../../www/report.ts';
import type { Event } from '../../www/store/events.ts';
import { needsRun } from '../../www/store/readiness.ts';
import { hasItsCones, isCurrent, shownResult, staleness } from '../../www/store/staleness.ts';
import type { State } from '../../www/store/state.ts';
import { after, DONE, DOUBT, mesh, OUTPUT, READY, REPORT, SWAPPED } from './fixtures.ts';

const OTHER: RunOptions = { method: 'thesis', base: 'qem', cones: 'uniform', class: 'runner-up', ownCones: 0, borders: 'missing' };
const PICKS: readonly Event[] = [
  { kind: 'point-picked', side: 0, point: 7 },
  { kind: 'point-picked', side: 1, point: 17 },
];
const saying = (state: State): string | null => {
  const changes = staleness(state);
  return changes === null ? null : staleSentence(changes);
};

describe('a result is outdated', () => {
  test('neither at first nor without a result', () => {
    expect(saying(DONE)).toBeNull();
    expect(saying(READY)).toBeNull();
    expect([isCurrent(DONE), isCurrent(READY)]).toEqual([true, false]);
  });

  test.each(Object.keys(OTHER) as (keyof RunOptions)[])('after another choice of %s, until it is taken back', (key) => {
    const changed = after(DONE, { kind: 'options', options: { [key]: OTHER[key] } });
    expect(saying(changed)).toBe('This map was made before the options changed.');
    expect(staleness(changed)?.options).toEqual([key]);
    expect(isCurrent(after(changed, { kind: 'options', options: { [key]: DONE.options[key] } }))).toBe(true);
    expect(isCurrent(after(changed, { kind: 'undo' }))).toBe(true);
  });

  test.each<[string, readonly Event[], string]>([
    ['a deleted pair', [{ kind: 'pair-deleted', id: 4 }], 'pair 4 was removed'],
    ['two exchanged targets', [{ kind: 'targets-exchanged', ids: [1, 2] }], '2 pairs were moved'],
    ['a moved point', [{ kind: 'point-moved', id: 3, side: 1, point: 99, gesture: 1 }], 'pair 3 was moved'],
    ['no pairs', [{ kind: 'pairs-cleared' }], '4 pairs were removed'],
    ['a new pair', PICKS, 'pair 5 was added'],
    ['another mesh', [{ kind: 'mesh', side: 1, file: mesh('horse.off') }], '4 pairs were removed'],
    [
      'several of these',
      [...PICKS, { kind: 'pair-deleted', id: 1 }, { kind: 'options', options: { method: 'thesis' } }],
      'pair 5 was added, pair 1 was removed and the options changed',
    ],
  ])('after %s, until it is undone', (_, events, words) => {
    const changed = after(DONE, ...events);
    expect(saying(changed)).toBe(`This map was made before ${words}.`);
    expect(changed.result).toBe(DONE.result);
    let back = changed;
    while (back.history.past.length > 0) {
      back = after(back, { kind: 'undo' });
    }
    expect(isCurrent(back)).toBe(true);
    expect(back.job).toEqual({ kind: 'done' });
  });

  test('neither by a label, a lock, another order, nor by a point that waits', () => {
    for (const event of [
      { kind: 'pair-labelled', id: 1, label: 'nose' },
      { kind: 'pair-locked', id: 1, locked: true },
      { kind: 'pair-moved', id: 1, to: 3 },
      PICKS[0],
    ] as const) {
      expect(event === undefined ? 'no event' : saying(after(DONE, event))).toBeNull();
    }
  });
});

describe('a result is shown', () => {
  test('while its meshes are on the page, and again when they come back', () => {
    expect(shownResult(DONE)).toBe(DONE.result);
    expect(shownResult(after(DONE, { kind: 'pairs-cleared' }))).toBe(DONE.result);
    const other = after(DONE, { kind: 'mesh', side: 1, file: mesh('horse.off') });
    expect([shownResult(other), other.job]).toEqual([null, { kind: 'idle' }]);
    expect(shownResult(after(other, { kind: 'undo' }))).toBe(DONE.result);
    expect(shownResult(after(DONE, { kind: 'swap-meshes' }))).toBeNull();
  });

  test('no more once no step leads back to its meshes', () => {
    const other = after(DONE, { kind: 'mesh', side: 1, file: mesh('horse.off') }, { kind: 'history-begun' });
    expect(after(other, { kind: 'pairs-cleared' }, { kind: 'mesh', side: 0, file: mesh('cow.off') }).result).toBeNull();
  });

  test('of what the run was about, when it ends after a change of the page', () => {
    const state = after(READY, { kind: 'run-started' }, { kind: 'pair-deleted', id: 4 }, { kind: 'run-done', output: OUTPUT, report: REPORT });
    expect(saying(state)).toBe('This map was made before pair 4 was removed.');
  });
});

describe('doubts', () => {
  const found = after(READY, { kind: 'run-started' }, { kind: 'run-found', findings: [SWAPPED] }, { kind: 'run-cancelled' });

  test('speak in numbers of the page', () => {
    const earlier = after(READY, { kind: 'pair-deleted', id: 1 }, { kind: 'pair-moved', id: 4, to: 0 }, { kind: 'pair-labelled', id: 2, label: 'nose' });
    const state = after(earlier, { kind: 'run-started' }, { kind: 'run-found', findings: [SWAPPED] });
    expect(state.findings[0]?.ids).toEqual([4, 2]);
    expect(state.findings[0]?.sentence).toMatch(/^The targets of the pairs 4 and 2 \(nose\) look swapped/);
  });

  test('go with what they are about, and come back with it', () => {
    expect(found.findings).toEqual([DOUBT]);
    const changed = after(found, { kind: 'targets-exchanged', ids: [1, 2] });
    expect(changed.findings).toEqual([]);
    expect(after(changed, { kind: 'undo' }).findings).toEqual([DOUBT]);
    expect(after(found, { kind: 'options', options: { method: 'thesis' } }).findings).toEqual([DOUBT]);
  });
});

test('a map that is current is not made again, one that was finished early is', () => {
  expect(needsRun(DONE)).toBe(false);
  expect(needsRun(READY)).toBe(true);
  expect(needsRun(after(DONE, { kind: 'pair-deleted', id: 1 }))).toBe(true);
  const early: State = { ...READY, result: { output: OUTPUT, report: { ...REPORT, stopped_early: true }, inputs: READY, opened: null } };
  expect(needsRun(early)).toBe(true);
});

test('a new pair leaves the cones of the others in place, a deleted one does not', () => {
  expect(hasItsCones(READY)).toBe(false);
  expect(hasItsCones(DONE)).toBe(true);
  expect(hasItsCones(after(DONE, ...PICKS))).toBe(true);
  expect(hasItsCones(after(DONE, { kind: 'pair-deleted', id: 4 }))).toBe(false);
  expect(hasItsCones(after(DONE, { kind: 'point-moved', id: 1, side: 0, point: 99, gesture: 1 }))).toBe(false);
});
