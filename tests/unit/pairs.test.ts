/** Picks, points that wait for their partner, suggestions and undo, over several events. */
import { describe, expect, test } from 'vitest';
import type { SurfacePoint } from '../../www/landmarks.ts';
import { pointsOf } from '../../www/store/points.ts';
import type { State } from '../../www/store/state.ts';
import { after, FOUR, pair, READY, suggestion } from './fixtures.ts';

const EMPTY: State = { ...READY, pairs: [] };
const IN_FACE: SurfacePoint = { face: 3, barycentric: [0.5, 0.25, 0.25] };

describe('a pick', () => {
  test('waits for its partner, which may be picked first on either side', () => {
    const source = after(EMPTY, { kind: 'picked', side: 0, point: 4 });
    expect(source.pending).toEqual({ side: 0, point: 4 });
    expect(source.pairs).toEqual([]);
    expect(after(source, { kind: 'picked', side: 1, point: IN_FACE }).pairs).toEqual([pair(4, IN_FACE)]);

    const target = after(EMPTY, { kind: 'picked', side: 1, point: 4 });
    expect(after(target, { kind: 'picked', side: 0, point: IN_FACE }).pairs).toEqual([pair(IN_FACE, 4)]);
  });

  test('on the same side takes the place of the one that waits', () => {
    const state = after(EMPTY, { kind: 'picked', side: 0, point: 4 }, { kind: 'picked', side: 0, point: 5 });
    expect(state.pending).toEqual({ side: 0, point: 5 });
    expect(state.pairs).toEqual([]);
  });

  test('of a point that has a pair is refused with the number of the pair', () => {
    const state = after(READY, { kind: 'picked', side: 1, point: 12 });
    expect(state.error).toMatch(/target.*pair 3/);
    expect({ ...state, error: null }).toEqual(READY);
    // The same number is another point on the other mesh.
    expect(after(READY, { kind: 'picked', side: 0, point: 12 }).error).toBeNull();
  });

  test('of a point in a face that has a pair is refused, too', () => {
    const state: State = { ...READY, pairs: [pair(IN_FACE, 1)] };
    const again: SurfacePoint = { face: 3, barycentric: [0.5, 0.25, 0.25] };
    expect(after(state, { kind: 'picked', side: 0, point: again }).error).toMatch(/source.*pair 1/);
  });

  test('takes its suggestion away', () => {
    const state: State = { ...EMPTY, suggestions: [[suggestion(4, 'A'), suggestion(5, 'B')], [suggestion(4, 'A')]] };
    const picked = after(state, { kind: 'picked', side: 0, point: 4 });
    expect(picked.suggestions).toEqual([[suggestion(5, 'B')], [suggestion(4, 'A')]]);
  });
});

describe('points that wait', () => {
  const taken = after(
    { ...EMPTY, suggestions: [[4, 5, 6].map((point) => suggestion(point, 'A')), []] },
    { kind: 'suggestions-taken', side: 0 },
  );

  test('come one after the other, and Escape skips one', () => {
    const first = after(taken, { kind: 'picked', side: 1, point: 14 });
    expect([first.pending, first.queue]).toEqual([{ side: 0, point: 5 }, [6]]);
    const skipped = after(first, { kind: 'pick-dropped' });
    expect([skipped.pending, skipped.queue]).toEqual([{ side: 0, point: 6 }, []]);
    const last = after(skipped, { kind: 'picked', side: 1, point: 16 });
    expect([last.pending, last.queue, last.pairs]).toEqual([null, [], [pair(4, 14), pair(6, 16)]]);
  });

  test('come after those that waited before', () => {
    const more = after(
      { ...taken, suggestions: [[suggestion(9, 'A')], []] },
      { kind: 'suggestions-taken', side: 0 },
    );
    expect([more.pending, more.queue]).toEqual([{ side: 0, point: 4 }, [5, 6, 9]]);
  });

  test('are none after Escape without any', () => {
    expect(after(EMPTY, { kind: 'pick-dropped' })).toBe(EMPTY);
  });
});

describe('undo', () => {
  test('goes back through every change of the pairs', () => {
    const state = after(
      READY,
      { kind: 'pair-deleted', index: 0 },
      { kind: 'targets-exchanged', indices: [0, 1] },
      { kind: 'pairs-cleared' },
      { kind: 'picked', side: 0, point: 4 },
      { kind: 'picked', side: 1, point: 14 },
    );
    const lists = [state.pairs];
    let present = state;
    for (let step = 0; step < 4; step++) {
      present = after(present, { kind: 'undo' });
      lists.push(present.pairs);
    }
    expect(lists).toEqual([
      [pair(4, 14)],
      [],
      [pair(1, 12), pair(2, 11), pair(3, 13)],
      [pair(1, 11), pair(2, 12), pair(3, 13)],
      FOUR,
    ]);
    expect(after(present, { kind: 'undo' })).toBe(present);
  });

  test('gives up what waits first, and leaves the pairs', () => {
    const state = after({ ...READY, history: [[]], queue: [8] }, { kind: 'picked', side: 0, point: 7 });
    const undone = after(state, { kind: 'undo' });
    expect([undone.pending, undone.queue, undone.pairs]).toEqual([null, [], FOUR]);
    expect(after(undone, { kind: 'undo' }).pairs).toEqual([]);
  });

  test('ends somewhere', () => {
    let state = READY;
    for (let step = 0; step < 1000; step++) {
      state = after(state, { kind: 'targets-exchanged', indices: [0, 1] });
    }
    expect(state.history.length).toBeGreaterThanOrEqual(100);
    expect(state.history.length).toBeLessThan(1000);
    // The latest are kept.
    expect(state.history.at(-1)?.[0]).toEqual(pair(0, 11));
  });
});

test('an exchange of pairs that are not there changes nothing', () => {
  expect(after(READY, { kind: 'targets-exchanged', indices: [0, 9] })).toBe(READY);
  expect(after(READY, { kind: 'targets-exchanged', indices: [0] })).toBe(READY);
});

test('the points of a side are those of the pairs and of the pending one', () => {
  expect(pointsOf(READY, 1)).toEqual([10, 11, 12, 13]);
  const state = after(READY, { kind: 'picked', side: 0, point: 7 });
  expect(pointsOf(state, 0)).toEqual([0, 1, 2, 3, 7]);
  expect(pointsOf(state, 1)).toEqual([10, 11, 12, 13, null]);
});
