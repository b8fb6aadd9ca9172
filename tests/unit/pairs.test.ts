/** Sequences of events: picks, half pairs and the order in which they are completed, moves, locks, numbers. */
import { describe, expect, test } from 'vitest';
import type { Pair, SurfacePoint } from '../../www/landmarks.ts';
import type { Event } from '../../www/store/events.ts';
import { pointsOf } from '../../www/store/points.ts';
import type { State } from '../../www/store/state.ts';
import { asked, waitingCount } from '../../www/store/waiting.ts';
import { after, FOUR, pair, READY, suggestion } from './fixtures.ts';

const EMPTY: State = { ...READY, pairs: [], nextId: 1 };
const IN_FACE: SurfacePoint = { face: 3, barycentric: [0.5, 0.25, 0.25] };
const LOCKED: State = { ...READY, pairs: FOUR.map((each) => (each.id === 2 ? { ...each, locked: true } : each)) };

const pick = (side: 0 | 1, point: SurfacePoint): Event => ({ kind: 'point-picked', side, point });
const select = (id: number | null): Event => ({ kind: 'pair-selected', id });
const turn = (state: State): [number, number] | null => {
  const next = asked(state);
  return next === null ? null : [next.pair.id, next.side];
};

describe('a pick', () => {
  test('begins a pair on either side, and is completed on the other', () => {
    const source = after(EMPTY, pick(0, 4));
    expect(source.pairs).toEqual([pair(1, 4, null)]);
    expect(turn(source)).toEqual([1, 1]);
    expect(after(source, pick(1, IN_FACE)).pairs).toEqual([pair(1, 4, IN_FACE)]);

    const target = after(EMPTY, pick(1, 4));
    expect(turn(target)).toEqual([1, 0]);
    expect(after(target, pick(0, IN_FACE)).pairs).toEqual([pair(1, IN_FACE, 4)]);
  });

  test('again on the same side begins another pair; they are completed in their order', () => {
    const three = after(EMPTY, pick(0, 4), pick(0, 5), pick(0, 6));
    expect(three.pairs).toEqual([pair(1, 4, null), pair(2, 5, null), pair(3, 6, null)]);
    expect(waitingCount(three, 1)).toBe(3);
    expect(after(three, pick(1, 14), pick(1, 15), pick(1, 16)).pairs).toEqual([pair(1, 4, 14), pair(2, 5, 15), pair(3, 6, 16)]);
  });

  test('completes the half pair that is selected, then the first that is left', () => {
    const three = after(EMPTY, pick(0, 4), pick(0, 5), pick(0, 6), select(2));
    expect(turn(three)).toEqual([2, 1]);
    const completed = after(three, pick(1, 15));
    expect(completed.pairs[1]).toEqual(pair(2, 5, 15));
    expect(turn(completed)).toEqual([1, 1]);
    // A selected pair with both points does not take the pick.
    expect(after(three, pick(1, 15), select(2), pick(1, 14)).pairs[0]).toEqual(pair(1, 4, 14));
  });

  test('on both sides begins no third pair', () => {
    const state = after(EMPTY, pick(0, 4), pick(0, 5), pick(1, 14), pick(1, 15), pick(1, 16));
    expect(state.pairs).toEqual([pair(1, 4, 14), pair(2, 5, 15), pair(3, null, 16)]);
    expect(turn(state)).toEqual([3, 0]);
  });

  test('selects the pair that it made whole where nothing waits', () => {
    expect(after(EMPTY, pick(0, 4), pick(1, 14)).ui.selected).toBe(1);
  });

  test('of a point that has a pair is refused with the number of the pair', () => {
    const state = after(READY, pick(1, 12));
    expect(state.error).toMatch(/target.*pair 3/);
    expect({ ...state, error: null }).toEqual(READY);
    // The same vertex number is another point on the other mesh.
    expect(after(READY, pick(0, 12)).error).toBeNull();
  });

  test('of a point in a face that has a pair is refused, too, and that of a half pair', () => {
    const again: SurfacePoint = { face: 3, barycentric: [0.5, 0.25, 0.25] };
    expect(after({ ...READY, pairs: [pair(1, IN_FACE, 1)] }, pick(0, again)).error).toMatch(/source.*pair 1/);
    expect(after(EMPTY, pick(0, IN_FACE), pick(0, again)).error).toMatch(/source.*pair 1/);
  });

  test('is rounded once: what is near to a landmark by less is the same point', () => {
    const state = after(EMPTY, pick(0, { face: 3, barycentric: [0.500_01, 0.249_96, 0.250_03] }));
    expect(state.pairs[0]?.points[0]).toEqual({ face: 3, barycentric: [0.5, 0.25, 0.25] });
    expect(after(state, pick(0, { face: 3, barycentric: [0.499_99, 0.250_01, 0.25] })).error).toMatch(/pair 1/);
  });

  test.each([
    [[1 / 3, 1 / 3, 1 / 3]],
    [[0.999_999, 0.000_001, 0]],
    [[-1e-17, 0.5, 0.5]],
    [[0.000_049, 0.499_951, 0.5]],
  ] as const)('in a face keeps weights that are not negative and sum to 1: %s', (barycentric) => {
    const point = after(EMPTY, pick(0, { face: 0, barycentric })).pairs[0]?.points[0];
    const weights = typeof point === 'object' ? (point?.barycentric ?? []) : [];
    expect(weights).toHaveLength(3);
    expect(Math.min(...weights)).toBeGreaterThanOrEqual(0);
    expect(weights.reduce((sum, weight) => sum + weight, 0)).toBeCloseTo(1, 15);
    weights.forEach((weight, corner) => {
      expect(Math.abs(weight - (barycentric[corner] ?? 0))).toBeLessThan(1.5e-4);
    });
  });

  test('takes its suggestion away', () => {
    const state: State = { ...EMPTY, suggestions: [[suggestion(4, 'A'), suggestion(5, 'B')], [suggestion(4, 'A')]] };
    expect(after(state, pick(0, 4)).suggestions).toEqual([[suggestion(5, 'B')], [suggestion(4, 'A')]]);
  });
});

describe('points that wait', () => {
  const taken = after(
    { ...EMPTY, suggestions: [[4, 5, 6].map((point) => suggestion(point, 'A')), []] },
    { kind: 'suggestions-taken', side: 0 },
  );

  test('come one after the other, and Escape gives one up', () => {
    const first = after(taken, pick(1, 14));
    expect(turn(first)).toEqual([2, 1]);
    const skipped = after(first, { kind: 'pick-dropped' });
    expect(turn(skipped)).toEqual([3, 1]);
    const last = after(skipped, pick(1, 16));
    expect([turn(last), last.pairs]).toEqual([null, [pair(1, 4, 14), pair(3, 6, 16)]]);
  });

  test('come after those that waited before, and those that are landmarks already are left out', () => {
    const more = after(
      { ...taken, suggestions: [[suggestion(9, 'A'), suggestion(5, 'B')], []] },
      { kind: 'suggestions-taken', side: 0 },
    );
    expect(turn(more)).toEqual([1, 1]);
    expect(more.pairs.map(({ points }) => points[0])).toEqual([4, 5, 6, 9]);
  });

  test('are none after Escape without any, which selects nothing', () => {
    expect(after(EMPTY, { kind: 'pick-dropped' })).toBe(EMPTY);
    expect(after(READY, select(2), { kind: 'pick-dropped' }).ui.selected).toBeNull();
  });
});

describe('a move', () => {
  test('puts one point elsewhere and selects its pair', () => {
    const state = after(READY, { kind: 'point-moved', id: 2, side: 0, point: IN_FACE, gesture: 1 });
    expect(state.pairs[1]).toEqual(pair(2, IN_FACE, 11));
    expect(state.ui.selected).toBe(2);
  });

  test('to where it is changes nothing', () => {
    expect(after(READY, { kind: 'point-moved', id: 2, side: 0, point: 1, gesture: 1 })).toBe(READY);
    expect(after(READY, { kind: 'point-moved', id: 9, side: 0, point: 1, gesture: 1 })).toBe(READY);
  });

  test('onto the point of another pair is refused', () => {
    const state = after(READY, { kind: 'point-moved', id: 2, side: 0, point: 3, gesture: 1 });
    expect([state.pairs, state.error]).toEqual([FOUR, expect.stringMatching(/source.*pair 4/)]);
  });
});

describe('a locked pair', () => {
  test.each<Event>([
    { kind: 'point-moved', id: 2, side: 0, point: 99, gesture: 1 },
    { kind: 'pair-deleted', id: 2 },
    { kind: 'targets-exchanged', ids: [1, 2] },
  ])('refuses $kind with a sentence', (event) => {
    const state = after(LOCKED, event);
    expect([state.pairs, state.history.past]).toEqual([LOCKED.pairs, []]);
    expect(state.error).toMatch(/^Pair 2 is locked/);
  });

  test('stays when all are deleted, and says so', () => {
    const state = after(LOCKED, { kind: 'pairs-cleared' });
    expect(state.pairs.map(({ id }) => id)).toEqual([2]);
    expect(state.toast?.sentence).toBe('3 landmark pairs deleted. 1 locked pair stayed.');
    expect(after(state, { kind: 'pairs-cleared' }).error).toMatch(/locked/);
  });

  test('is free again when unlocked', () => {
    const free = after(LOCKED, { kind: 'pair-locked', id: 2, locked: false }, { kind: 'pair-deleted', id: 2 });
    expect(free.pairs).toHaveLength(3);
  });
});

describe('numbers and ids', () => {
  const numbers = (state: State): number[] => state.pairs.map(({ number }) => number);

  test('of the others stay when a pair goes, and a new pair has the next one', () => {
    const state = after(READY, { kind: 'pair-deleted', id: 2 }, pick(0, 20));
    expect(numbers(state)).toEqual([1, 3, 4, 5]);
  });

  test('begin anew with other landmarks; ids never come again', () => {
    const seen = new Set<Pair['id']>();
    let state = READY;
    const steps: Event[] = [
      { kind: 'pairs-cleared' },
      pick(0, 20),
      { kind: 'undo' },
      pick(0, 21),
      { kind: 'landmarks', file: { pairs: [[1, 2], [3, 4]] } },
    ];
    for (const event of steps) {
      const before = new Set(state.pairs.map(({ id }) => id));
      state = after(state, event);
      for (const { id } of state.pairs.filter(({ id: candidate }) => !before.has(candidate))) {
        expect(seen).not.toContain(id);
        seen.add(id);
      }
    }
    expect(numbers(state)).toEqual([1, 2]);
  });

  test('go along when pairs are reordered', () => {
    const state = after(READY, { kind: 'pair-moved', id: 1, to: 99 });
    expect(state.pairs.map(({ id, number }) => [id, number])).toEqual([[2, 2], [3, 3], [4, 4], [1, 1]]);
    expect(after(READY, { kind: 'pair-moved', id: 1, to: -5 })).toBe(READY);
    expect(after(READY, { kind: 'pair-moved', id: 9, to: 0 })).toBe(READY);
    expect(after(READY, { kind: 'pair-moved', id: 2, to: Number.NaN })).toBe(READY);
  });

  test('place the points that the views mark', () => {
    expect(pointsOf(READY, 1)).toEqual([10, 11, 12, 13]);
    const state = after(READY, { kind: 'pair-deleted', id: 2 }, { kind: 'pair-moved', id: 4, to: 0 }, pick(0, 7));
    expect(pointsOf(state, 0)).toEqual([0, null, 2, 3, 7]);
    expect(pointsOf(state, 1)).toEqual([10, null, 12, 13, null]);
  });
});

test('a deleted pair leaves the next one selected, the last one the one before it', () => {
  const second = after(READY, select(2), { kind: 'pair-deleted', id: 2 });
  expect(second.ui.selected).toBe(3);
  const last = after(READY, select(4), { kind: 'pair-deleted', id: 4 });
  expect(last.ui.selected).toBe(3);
  expect(after(READY, select(1), { kind: 'pair-deleted', id: 4 }).ui.selected).toBe(1);
});

test('an exchange of pairs that are not there changes nothing', () => {
  for (const ids of [[1, 9], [1], [1, 1]]) {
    expect(after(READY, { kind: 'targets-exchanged', ids })).toBe(READY);
  }
});
