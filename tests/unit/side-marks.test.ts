/** The landmarks of one mesh, from a file for that mesh alone. */
import { describe, expect, test } from 'vitest';
import type { SurfacePoint } from '../../www/landmarks.ts';
import type { Event } from '../../www/store/events.ts';
import { INITIAL } from '../../www/store/state.ts';
import { after, mesh, pair, READY } from './fixtures.ts';

function marks(side: 0 | 1, points: readonly (readonly [string, SurfacePoint])[]): Event {
  return { kind: 'side-marks', side, points: points.map(([label, point]) => ({ label, point })), name: 'cat.fcsv' };
}

const EMPTY = after(
  INITIAL,
  { kind: 'mesh', side: 0, file: mesh('cat.off') },
  { kind: 'mesh', side: 1, file: mesh('lion.off') },
);

describe('the points of one mesh', () => {
  test('wait for their partners where there are none', () => {
    const state = after(EMPTY, marks(0, [['nose', 5], ['tail', 6]]));
    expect(state.pairs).toEqual([pair(1, 5, null, 'nose'), pair(2, 6, null, 'tail')]);
    expect(state.history.past.at(-1)?.name).toBe('Load cat.fcsv');
  });

  test('find their partners by equal labels', () => {
    const state = after(EMPTY, marks(0, [['nose', 5], ['tail', 6]]), marks(1, [['tail', 16], ['nose', 15]]));
    expect(state.pairs).toEqual([pair(1, 5, 15, 'nose'), pair(2, 6, 16, 'tail')]);
  });

  test('find them by order where the labels differ', () => {
    const state = after(EMPTY, marks(0, [['nose', 5], ['', 6]]), marks(1, [['tail', 16], ['ear', 15]]));
    expect(state.pairs).toEqual([pair(1, 5, 16, 'nose'), pair(2, 6, 15, 'ear')]);
  });

  test('wait beside the others where these are more or fewer', () => {
    const state = after(EMPTY, marks(0, [['nose', 5], ['tail', 6]]), marks(1, [['nose', 15]]));
    expect(state.pairs).toEqual([pair(1, 5, null, 'nose'), pair(2, 6, null, 'tail'), pair(3, null, 15, 'nose')]);
  });

  test('come in the place of those on it, and undo brings these back', () => {
    const points = READY.pairs.map((_, index) => ['', 20 + index] as const);
    const state = after(READY, marks(1, points));
    expect(state.pairs.map((pair) => pair.points)).toEqual([[0, 20], [1, 21], [2, 22], [3, 23]]);
    expect(after(state, { kind: 'undo' }).pairs).toEqual(READY.pairs);
    const fewer = after(READY, marks(1, [['', 20]]));
    expect(fewer.pairs.map((pair) => pair.points)).toEqual([[0, null], [1, null], [2, null], [3, null], [null, 20]]);
    expect(fewer.toast?.undo).toBe(true);
  });

  test('do not move a locked pair', () => {
    const [first, ...rest] = READY.pairs;
    const locked = { ...READY, pairs: first === undefined ? rest : [{ ...first, locked: true }, ...rest] };
    const state = after(locked, marks(1, [['', 20]]));
    expect(state.pairs).toEqual(locked.pairs);
    expect(state.error).toMatch(/locked/);
  });
});
