/** Undo and redo through steps of all kinds; drags; meshes that no step leads back to. */
import { beforeEach, describe, expect, test } from 'vitest';
import { freeForgotten } from '../../www/app/open.ts';
import type { Side, SurfacePoint } from '../../www/landmarks.ts';
import { SIDES } from '../../www/landmarks.ts';
import { change } from '../../www/store/change.ts';
import type { Event } from '../../www/store/events.ts';
import { heldMeshes } from '../../www/store/history.ts';
import type { Axis, State, Work } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { workOf } from '../../www/store/work.ts';
import { after, DEMO, FOUR, mesh, pair, READY, suggestion } from './fixtures.ts';

/** Random numbers from 0 to 1 for a seed (mulberry32). */
function numbersOf(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Random events like those of a user, some of them impossible. */
function eventsOf(seed: number): (state: State) => Event[] {
  const random = numbersOf(seed);
  const whole = (end: number): number => Math.floor(random() * end);
  const one = <T>(list: readonly T[]): T => list[whole(list.length)] ?? (list[0] as T);
  const side = (): Side => one(SIDES);
  const point = (): SurfacePoint =>
    random() < 0.5 ? whole(12) : { face: whole(3), barycentric: [random() / 2, random() / 2, 0.3] };
  const file = (): ReturnType<typeof mesh> => mesh(one(['cat.off', 'lion.off', 'cow.stl']));
  let gesture = 0;
  return (state) => {
    const id = random() < 0.9 ? (one([...state.pairs, pair(1, 0, 0)]).id) : 999;
    const other = one([...state.pairs, pair(1, 0, 0)]).id;
    gesture += whole(2);
    const makers: (() => Event[])[] = [
      () => [{ kind: 'mesh', side: side(), file: file() }],
      () => [{ kind: 'mesh', side: 0, file: file() }, { kind: 'mesh', side: 1, file: file() }, { kind: 'landmarks', file: { pairs: [[1, 2], [3, 4]] } }, { kind: 'demo', demo: DEMO }],
      () => [{ kind: 'mirrored', file: file(), points: state.pairs.map(({ points }) => points[1]) }],
      () => [{ kind: 'swap-meshes' }],
      () => [{ kind: 'landmarks', file: { pairs: [[5, 6]], labels: ['nose'], source: 'cat.off' } }],
      () => [{ kind: 'point-picked', side: side(), point: point() }],
      () => [{ kind: 'point-picked', side: side(), point: point() }],
      () => [{ kind: 'point-moved', id, side: side(), point: point(), gesture }],
      () => [{ kind: 'pick-dropped' }],
      () => [{ kind: 'suggested', side: 0, suggestions: [suggestion(whole(20), 'A'), suggestion(20 + whole(20), 'B')] }],
      () => [{ kind: 'suggestions-taken', side: 0 }],
      () => [{ kind: 'pair-deleted', id }],
      () => [{ kind: 'pair-labelled', id, label: one(['', 'nose', 'tail']) }],
      () => [{ kind: 'pair-locked', id, locked: random() < 0.3 }],
      () => [{ kind: 'pair-moved', id, to: whole(6) - 1 }],
      () => [{ kind: 'pairs-cleared' }],
      () => [{ kind: 'targets-exchanged', ids: [id, other] }],
      () => [{ kind: 'options', options: { ownCones: one([null, 0, 10]) } }],
      () => [{ kind: 'up', side: side(), axis: one<Axis>(['x', 'y', '-z']) }],
      () => [{ kind: 'pair-selected', id: random() < 0.5 ? id : null }],
      () => [{ kind: 'run-started' }, { kind: 'run-cancelled' }],
    ];
    return one(makers)();
  };
}

/** The part of the work that a step brings back: all but the axes that point up, which belong to the meshes. */
function contentOf(work: Work): Omit<Work, 'up'> {
  const { meshes, demo, pairs, named, groundTruth, options } = workOf(work);
  return { meshes, demo, pairs, named, groundTruth, options };
}

function expectSound({ pairs, ui, meshes }: State): void {
  expect(new Set(pairs.map(({ id }) => id)).size).toBe(pairs.length);
  expect(new Set(pairs.map(({ number }) => number)).size).toBe(pairs.length);
  for (const side of SIDES) {
    const points = pairs.flatMap(({ points: both }) => (both[side] === null ? [] : [JSON.stringify(both[side])]));
    expect(new Set(points).size).toBe(points.length);
  }
  expect(pairs.every(({ points }) => points[0] !== null || points[1] !== null)).toBe(true);
  expect([null, ...pairs.map(({ id }) => id)]).toContain(ui.selected);
  expect(meshes).toHaveLength(2);
}

describe.each([1, 2, 3, 4, 5, 6, 7, 8])('after 150 events of seed %i', (seed) => {
  let store: Store;
  /** The work before each step, and after the last one. */
  let works: Omit<Work, 'up'>[];

  beforeEach(() => {
    store = new Store();
    const next = eventsOf(seed);
    works = [contentOf(store.state)];
    for (let count = 0; count < 150; count++) {
      const { past } = store.state.history;
      store.dispatch(...next(store.state));
      expectSound(store.state);
      const grown = store.state.history.past.length - past.length;
      expect(grown === 0 || grown === 1).toBe(true);
      // A drag that goes on changes the last step.
      works.splice(grown === 1 ? works.length : -1, grown === 1 ? 0 : 1, contentOf(store.state));
    }
    expect(works.length).toBeGreaterThan(40);
  });

  test('undo goes back through all works to the first, and redo through the same ones to the last', () => {
    const [first, last] = [works[0], works.at(-1)];
    const names: string[] = [];
    for (const work of works.slice(0, -1).reverse()) {
      names.push(store.state.history.past.at(-1)?.name ?? '');
      store.dispatch({ kind: 'undo' });
      expect(contentOf(store.state)).toEqual(work);
      expectSound(store.state);
    }
    expect(contentOf(store.state)).toEqual(first);
    expect(names).not.toContain('');
    expect(names).not.toContain('Change');
    const before = store.state;
    store.dispatch({ kind: 'undo' });
    expect(store.state).toBe(before);

    for (const work of works.slice(1)) {
      expect(store.state.history.future.at(-1)?.name).toBe(names.pop());
      store.dispatch({ kind: 'redo' });
      expect(contentOf(store.state)).toEqual(work);
    }
    expect(contentOf(store.state)).toEqual(last);
    const end = store.state;
    store.dispatch({ kind: 'redo' });
    expect(store.state).toBe(end);
  });

  test('a step after undo leaves no redo', () => {
    store.dispatch({ kind: 'undo' });
    expect(store.state.history.future).toHaveLength(1);
    store.dispatch({ kind: 'options', options: { method: 'thesis' } });
    expect(store.state.history.future).toEqual([]);
  });
});

describe('a drag', () => {
  const move = (point: number, gesture: number): Event => ({ kind: 'point-moved', id: 2, side: 0, point, gesture });

  test('is one step from where it began', () => {
    const dragged = after(READY, move(20, 1), move(21, 1), move(22, 1));
    expect(dragged.pairs[1]).toEqual(pair(2, 22, 11));
    expect(dragged.history.past.map(({ name }) => name)).toEqual(['Move pair 2']);
    expect(after(dragged, { kind: 'undo' }).pairs).toEqual(FOUR);
    expect(after(dragged, { kind: 'undo' }, { kind: 'redo' }).pairs).toEqual(dragged.pairs);
  });

  test('is another step than the drag before, and than what came between', () => {
    expect(after(READY, move(20, 1), move(21, 2)).history.past).toHaveLength(2);
    const between = after(READY, move(20, 1), { kind: 'pair-labelled', id: 2, label: 'nose' }, move(21, 1));
    expect(between.history.past).toHaveLength(3);
    expect(after(READY, move(20, 1), { kind: 'undo' }, move(21, 1)).history.past).toHaveLength(1);
  });
});

describe('events that come together', () => {
  test('are one step, named for what was opened', () => {
    const store = new Store();
    store.dispatch({ kind: 'mesh', side: 0, file: mesh('cat.off') }, { kind: 'mesh', side: 1, file: mesh('lion.off') });
    store.dispatch(
      { kind: 'mesh', side: 0, file: mesh('a.obj') },
      { kind: 'mesh', side: 1, file: mesh('b.obj') },
      { kind: 'landmarks', file: { pairs: [[1, 2]] } },
      { kind: 'demo', demo: DEMO },
    );
    store.dispatch({ kind: 'mesh', side: 0, file: mesh('cow.off') }, { kind: 'landmarks', file: { pairs: [[1, 2]] } });
    expect(store.state.history.past.map(({ name }) => name)).toEqual([
      'Open cat.off and lion.off',
      'Open the demo “Ball”',
      'Open cow.off',
    ]);
  });

  test('with undo among them take back only what came before it', () => {
    const store = new Store();
    store.dispatch({ kind: 'landmarks', file: { pairs: [[1, 2]] } });
    store.dispatch({ kind: 'point-picked', side: 0, point: 3 }, { kind: 'undo' }, { kind: 'point-picked', side: 0, point: 4 });
    expect(store.state.pairs.map(({ points }) => points[0])).toEqual([1, 4]);
    expect(store.state.history.past.map(({ name }) => name)).toEqual(['Load 1 pair', 'Begin pair 2']);
  });
});

describe('the toast of a step that dropped something', () => {
  test('goes with the next step, and with undo', () => {
    const cleared = after(READY, { kind: 'pairs-cleared' });
    expect(cleared.toast?.undo).toBe(true);
    expect(after(cleared, { kind: 'point-picked', side: 0, point: 3 }).toast).toBeNull();
    expect(after(cleared, { kind: 'undo' })).toMatchObject({ toast: null, pairs: FOUR });
    // A change that is not a step leaves the toast.
    expect(after(cleared, { kind: 'style', style: { cones: false } }).toast).toBe(cleared.toast);
  });

  test('is there for a demo over landmarks, and not over an empty page', () => {
    const demo: Event[] = [{ kind: 'landmarks', file: { pairs: [[1, 2]] } }, { kind: 'demo', demo: DEMO }];
    const store = new Store();
    store.dispatch(...demo);
    expect(store.state.toast).toBeNull();
    store.dispatch(...demo);
    expect(store.state.toast).toEqual({ sentence: '1 landmark pair removed.', undo: true });
  });

  test('is there for a demo over own meshes, also without landmarks, as when the browser goes back to its link', () => {
    const own = after(INITIAL, { kind: 'mesh', side: 0, file: mesh('cat.off') });
    const demo = change(own, [{ kind: 'mesh', side: 0, file: mesh('ball.obj') }, { kind: 'demo', demo: DEMO }]);
    expect(demo.toast).toEqual({ sentence: 'The demo took the place of cat.', undo: true });
    expect(after(demo, { kind: 'undo' }).meshes).toBe(own.meshes);
  });
});

describe('the memory of meshes', () => {
  test.each([11, 12, 13])('is given back once, when no step leads to them: seed %i', (seed) => {
    const store = new Store();
    const made = new Map<unknown, ReturnType<typeof mesh>>();
    const random = numbersOf(seed);
    store.subscribe(freeForgotten);
    store.subscribe((state) => {
      const held = heldMeshes(state.history, state);
      for (const file of made.values()) {
        expect(file.freed()).toBe(held.has(file) ? 0 : 1);
      }
    });
    for (let count = 0; count < 300; count++) {
      const kind = random();
      if (kind < 0.4) {
        const file = mesh(`${count}.off`);
        made.set(count, file);
        store.dispatch({ kind: 'mesh', side: random() < 0.5 ? 0 : 1, file });
      } else {
        store.dispatch({ kind: kind < 0.7 ? 'undo' : kind < 0.9 ? 'redo' : 'swap-meshes' });
      }
    }
    expect([...made.values()].filter((file) => file.freed() === 1).length).toBeGreaterThan(10);
  });

  test('is bounded: the oldest steps go first', () => {
    const store = new Store();
    store.subscribe(freeForgotten);
    // The meshes take a fifth of what the past may hold.
    const files = Array.from({ length: 12 }, (_, index) => mesh(`${index}.off`, 1.3e6));
    for (const file of files) {
      store.dispatch({ kind: 'mesh', side: 0, file });
    }
    const freed = files.map((file) => file.freed());
    expect(freed).toEqual([1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0]);
    while (store.state.history.past.length > 0) {
      store.dispatch({ kind: 'undo' });
    }
    expect(store.state.meshes[0]).toBe(files[6]);
  });

  test('does not grow by steps that change no mesh, of which the latest 200 are kept', () => {
    let state: State = { ...READY, meshes: [mesh('a.off', 1e7), mesh('b.off', 1e7)] };
    for (let step = 0; step < 500; step++) {
      state = after(state, { kind: 'targets-exchanged', ids: [1, 2] });
    }
    expect(state.history.past).toHaveLength(200);
    expect(state.history.past.at(-1)?.work.pairs[0]).toEqual(pair(1, 0, 11));
  });
});

test('a dispatch that changes nothing tells nobody', () => {
  const store = new Store();
  store.subscribe(() => {
    expect.unreachable();
  });
  store.dispatch({ kind: 'undo' }, { kind: 'redo' }, { kind: 'toast-closed' }, { kind: 'pair-selected', id: null });
  expect(store.state).toBe(INITIAL);
});

test('locks that change together are one step, named by their number', () => {
  const store = new Store();
  store.dispatch({ kind: 'landmarks', file: { pairs: [[0, 0], [1, 1], [2, 2]] } });
  const [a, b] = store.state.pairs;
  store.dispatch({ kind: 'pair-locked', id: a?.id ?? 0, locked: true }, { kind: 'pair-locked', id: b?.id ?? 0, locked: true });
  expect(store.state.history.past.at(-1)?.name).toBe('Lock 2 pairs');
  store.dispatch({ kind: 'pair-locked', id: b?.id ?? 0, locked: false });
  expect(store.state.history.past.at(-1)?.name).toBe('Unlock pair 2');
});
