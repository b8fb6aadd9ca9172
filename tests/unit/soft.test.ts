/** Soft pairs: they are made, settled by a run, held, and undone; the effect of locks and of changes during the run. */
import { describe, expect, test } from 'vitest';
import type { SettledLandmark } from '../../www/report.ts';
import type { Event } from '../../www/store/events.ts';
import { landmarkFileOf } from '../../www/store/landmark-file.ts';
import { hasItsCones, isCurrent, staleness } from '../../www/store/staleness.ts';
import type { State } from '../../www/store/state.ts';
import { after, DONE, OUTPUT, pair, READY, REPORT } from './fixtures.ts';

const PLACE = { face: 4, barycentric: [0.25, 0.5, 0.25] } as const;
const soften = (id: number, radius: number | null): Event => ({ kind: 'pair-softened', id, radius });
const done = (settled: readonly SettledLandmark[]): Event => ({ kind: 'run-done', output: OUTPUT, report: { ...REPORT, settled } });
const SETTLED: SettledLandmark = { pair: 1, point: { face: 4, barycentric: [0.25, 0.5, 0.25] }, moved: 0.012 };

/** A state in which pair 2 is soft and a run has begun. */
function running(): State {
  return after(READY, soften(2, 0.02), { kind: 'run-started' });
}

test('a soft pair has its radius in the file for the core, and the others have none', () => {
  expect(landmarkFileOf(after(READY, soften(2, 0.02))).radii).toEqual([0, 0.02, 0, 0]);
  expect(landmarkFileOf(READY).radii).toBeUndefined();
});

test('a locked pair is held', () => {
  expect(landmarkFileOf(after(READY, soften(2, 0.02), { kind: 'pair-locked', id: 2, locked: true })).radii).toBeUndefined();
});

test('a file with radii brings soft pairs, and gives them back', () => {
  const file = { pairs: [[0, 1], [2, 3]] as const, radii: [0, 0.1] };
  const { pairs } = after(READY, { kind: 'landmarks', file });
  expect(pairs.map(({ radius }) => radius)).toEqual([undefined, 0.1]);
  expect(landmarkFileOf({ ...READY, pairs }).radii).toEqual([0, 0.1]);
});

test.each([0, -0.1, 0.3, Number.NaN])('a radius of %s is none', (radius) => {
  expect(after(READY, soften(2, radius)).pairs).toBe(READY.pairs);
});

describe('after the run', () => {
  test('the pair is where it settled, and held there; the map is of that', () => {
    const state = after(running(), done([SETTLED]));
    expect(state.pairs[1]).toEqual({ ...pair(2, 1, 11), points: [1, PLACE] });
    expect(isCurrent(state)).toBe(true);
    expect(landmarkFileOf(state).radii).toBeUndefined();
    expect(state.toast?.sentence).toBe('The soft pair settled, 1.2 % of the target’s size away, and is held there.');
  });

  test('undo gives the click and its radius back, and redo the map', () => {
    const state = after(running(), done([SETTLED]));
    expect(state.history.past.at(-1)?.name).toBe('Settle 1 soft pair');
    const back = after(state, { kind: 'undo' });
    expect(back.pairs[1]).toEqual({ ...pair(2, 1, 11), radius: 0.02 });
    expect(isCurrent(back)).toBe(false);
    expect(isCurrent(after(back, { kind: 'redo' }))).toBe(true);
  });

  test('a pair that has changed meanwhile stays as it is', () => {
    const moved = after(running(), { kind: 'point-moved', id: 2, side: 1, point: 77, gesture: 1 });
    const state = after(moved, done([SETTLED]));
    expect(state.pairs[1]?.points).toEqual([1, 77]);
    expect(staleness(state)?.moved).toEqual([2]);
    expect(state.result?.inputs.pairs[1]?.points).toEqual([1, PLACE]);
  });

  test('without soft pairs nothing is a step', () => {
    const state = after(after(READY, { kind: 'run-started' }), done([]));
    expect(state.pairs).toBe(READY.pairs);
    expect(state.history).toBe(READY.history);
  });
});

test('a pair that becomes soft makes another map, on the same cones', () => {
  const state = after(DONE, soften(3, 0.05));
  expect(staleness(state)?.softened).toEqual([3]);
  expect(hasItsCones(state)).toBe(true);
  expect(isCurrent(after(state, soften(3, null)))).toBe(true);
});
