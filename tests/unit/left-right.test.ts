/** Points that come in pairs of left and right: picks, undo, moves, locks, labels, and mirror images. */
import { describe, expect, test, vi } from 'vitest';
import { completed, Planes } from '../../www/app/left-right.ts';
import type { Mirror } from '../../www/app/left-right.ts';
import type { Side, SurfacePoint } from '../../www/landmarks.ts';
import type { FileReader } from '../../www/reading/reader.ts';
import { planeInUse, twinOf } from '../../www/store/across.ts';
import type { Event } from '../../www/store/events.ts';
import type { Across, MeshPlane, PlaneAnswer } from '../../www/store/left-right.ts';
import { otherName } from '../../www/store/side-names.ts';
import type { State } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { asked } from '../../www/store/waiting.ts';
import { isCurrent } from '../../www/store/staleness.ts';
import { after, DONE, FOUR, mesh, pair, READY, suggestion } from './fixtures.ts';

const ANSWER: PlaneAnswer = { plane: { normal: [1, 0, 0], through: [0, 0, 0] }, misfit: 0.002, fits: true };
const [CAT, LION] = READY.meshes;
const planeOf = (of: State['meshes'][0], change: Partial<MeshPlane> = {}): MeshPlane => ({
  of: of ?? mesh('none'),
  choice: 'found',
  answer: ANSWER,
  ...change,
});
/** A state in which both meshes have planes, and points come in pairs. */
const ON: State = { ...READY, leftRight: { isOn: true, planes: [planeOf(CAT), planeOf(LION)], twins: [] } };
const EMPTY: State = { ...ON, pairs: [], nextId: 1 };

/** The mirror image of a vertex: the vertex whose number is larger by a hundred, at distance 0. */
const across = (point: SurfacePoint | null): Across => ({ point, distance: 0, pair: null });
const pick = (side: Side, point: number): Event => ({ kind: 'point-picked', side, point, across: across(point + 100) });
const move = (id: number, side: Side, point: number, gesture = 1): Event => ({
  ...{ kind: 'point-moved', id, side, point, gesture },
  across: across(point + 100),
});
const TWO = after(EMPTY, pick(0, 4), pick(1, 14));
const locked = (state: State, id: number): State => after(state, { kind: 'pair-locked', id, locked: true });

describe('a pick', () => {
  test('begins two pairs, and is completed for both on the other mesh', () => {
    const begun = after(EMPTY, pick(0, 4));
    expect(begun.pairs).toEqual([pair(1, 4, null), pair(2, 104, null)]);
    expect([asked(begun)?.pair.id, begun.ui.selected]).toEqual([1, 1]);
    expect(TWO.pairs).toEqual([pair(1, 4, 14), pair(2, 104, 114)]);
    expect([asked(TWO), TWO.ui.selected]).toEqual([null, 1]);
    expect(twinOf(TWO, 2)).toBe(TWO.pairs[0]);
  });

  test('is one step with its partner, to undo and to redo', () => {
    expect(TWO.history.past.map(({ name }) => name)).toEqual(['Begin pairs 1 and 2', 'Place pairs 1 and 2']);
    const half = after(TWO, { kind: 'undo' });
    expect(half.pairs).toEqual([pair(1, 4, null), pair(2, 104, null)]);
    expect(after(half, { kind: 'undo' }).pairs).toEqual([]);
    const again = after(half, { kind: 'redo' });
    expect(again.pairs).toEqual(TWO.pairs);
    expect(twinOf(again, 1)?.id).toBe(2);
  });

  test('may come first on the target, and several before they are completed', () => {
    const four = after(EMPTY, pick(1, 14), pick(1, 15), pick(0, 4), pick(0, 5));
    expect(four.pairs).toEqual([pair(1, 4, 14), pair(2, 104, 114), pair(3, 5, 15), pair(4, 105, 115)]);
    expect(asked(four)).toBeNull();
  });

  test('of the partner completes the first one likewise', () => {
    const begun = after(EMPTY, pick(0, 4), { kind: 'pair-selected', id: 2 });
    expect(after(begun, pick(1, 50)).pairs).toEqual([pair(1, 4, 150), pair(2, 104, 50)]);
  });

  test('on the midline stays single', () => {
    const single: Event = { kind: 'point-picked', side: 0, point: 4, across: across(null) };
    const begun = after(EMPTY, single);
    expect(begun.pairs).toEqual([pair(1, 4, null)]);
    expect(after(begun, pick(1, 14)).pairs).toEqual([pair(1, 4, 14)]);
  });

  test('beside a pair that is across already begins no second one there', () => {
    const there = after(ON, { ...pick(0, 4), across: { ...across(104), pair: 3 } } as Event);
    expect(there.pairs).toHaveLength(5);
    expect(twinOf(there, 5)?.id).toBe(3);
    // The mirror image lies exactly at a point that has a pair.
    expect(after(ON, { ...pick(0, 4), across: across(2) } as Event).pairs).toHaveLength(5);
  });

  test('waits for a click for its partner where the other mesh has no plane', () => {
    const begun = after(EMPTY, pick(0, 4), { kind: 'point-picked', side: 1, point: 14, across: null });
    expect([begun.pairs, asked(begun)?.pair.id]).toEqual([[pair(1, 4, 14), pair(2, 104, null)], 2]);
  });

  test('that is refused makes no partner', () => {
    const refused = after(ON, pick(0, 2));
    expect([refused.pairs, refused.error]).toEqual([FOUR, expect.stringMatching(/pair 3/)]);
  });

  test('tells a partner that is far off its mirror image', () => {
    const far: Event = { kind: 'point-picked', side: 0, point: 4, across: { ...across(104), distance: 0.023 } };
    expect(after(EMPTY, far).toast).toEqual({ sentence: expect.stringContaining('2.3 %') as string, undo: true });
    expect(after(EMPTY, pick(0, 4)).toast).toBeNull();
  });

  test('given up by Escape goes with its partner', () => {
    const begun = after(EMPTY, pick(0, 4));
    const dropped = after(begun, { kind: 'pick-dropped' });
    expect([dropped.pairs, asked(dropped)]).toEqual([[], null]);
    const off = after(begun, { kind: 'left-right', isOn: false }, { kind: 'pick-dropped' });
    expect(off.pairs).toEqual([pair(2, 104, null)]);
  });
});

describe('a move', () => {
  test('takes the partner along, and both are one step', () => {
    const moved = after(TWO, move(1, 0, 6), move(1, 0, 7));
    expect(moved.pairs).toEqual([pair(1, 7, 14), pair(2, 107, 114)]);
    expect(moved.history.past.length).toBe(TWO.history.past.length + 1);
    expect(after(moved, { kind: 'undo' }).pairs).toEqual(TWO.pairs);
    expect(after(TWO, move(2, 1, 8)).pairs).toEqual([pair(1, 4, 108), pair(2, 104, 8)]);
  });

  test('leaves a partner that is locked, and one whose place another pair has', () => {
    expect(after(locked(TWO, 2), move(1, 0, 6)).pairs.map(({ points }) => points)).toEqual([
      [6, 14],
      [104, 114],
    ]);
    const three = after(TWO, { kind: 'point-picked', side: 0, point: 106 }, move(1, 0, 6));
    expect(three.pairs.map(({ points }) => points[0])).toEqual([6, 104, 106]);
  });

  test('of a locked pair moves neither', () => {
    const still = locked(TWO, 1);
    const after1 = after(still, move(1, 0, 6));
    expect([after1.pairs, after1.error]).toEqual([still.pairs, expect.stringMatching(/locked/)]);
  });

  test('onto the midline leaves the partner where it is', () => {
    const moved = after(TWO, { ...move(1, 0, 6), across: across(null) } as Event);
    expect(moved.pairs).toEqual([pair(1, 6, 14), pair(2, 104, 114)]);
  });

  test('of a proposed place places both', () => {
    const begun = after(EMPTY, pick(0, 4));
    expect(after(begun, move(1, 1, 14)).pairs).toEqual([pair(1, 4, 14), pair(2, 104, 114)]);
  });

  test('without what lies across moves one alone', () => {
    const moved = after(TWO, { kind: 'point-moved', id: 1, side: 0, point: 6, gesture: 1 });
    expect(moved.pairs).toEqual([pair(1, 6, 14), pair(2, 104, 114)]);
  });
});

test('one of two that is deleted leaves the other one a pair like any', () => {
  const one = after(TWO, { kind: 'pair-deleted', id: 1 });
  expect([one.pairs, twinOf(one, 2)]).toEqual([[pair(2, 104, 114)], null]);
  expect(after(one, move(2, 0, 6)).pairs).toEqual([pair(2, 6, 114)]);
  expect(twinOf(after(one, { kind: 'undo' }), 2)?.id).toBe(1);
});

describe('suggestions that look alike', () => {
  const rings = [
    { ...suggestion(4, 'A'), partner: 'C' },
    suggestion(5, 'B'),
    { ...suggestion(105, 'C'), partner: 'A' },
  ];
  const SUGGESTED: State = { ...EMPTY, suggestions: [rings, []] };
  const letters = (state: State): string[] => state.suggestions[0].map(({ letter }) => letter);

  test('are taken by one click', () => {
    const taken = after(SUGGESTED, pick(0, 4));
    expect([letters(taken), taken.pairs.length]).toEqual([['B'], 2]);
    expect(letters(after(SUGGESTED, pick(0, 5)))).toEqual(['A', 'C']);
    expect(letters(after({ ...SUGGESTED, leftRight: READY.leftRight }, { kind: 'point-picked', side: 0, point: 4 }))).toEqual(['B', 'C']);
  });

  test('go together when all are taken', () => {
    const all = after(SUGGESTED, { kind: 'suggestions-taken', side: 0 });
    expect([all.pairs.length, twinOf(all, 1)?.id, twinOf(all, 2)]).toEqual([3, 3, null]);
    expect(after(all, pick(1, 14)).pairs).toEqual([pair(1, 4, 14), pair(2, 5, null), pair(3, 105, 114)]);
    const off = after({ ...SUGGESTED, leftRight: READY.leftRight }, { kind: 'suggestions-taken', side: 0 });
    expect(twinOf(off, 1)).toBeNull();
  });
});

test('what the map proposes is taken for both', () => {
  const begun: State = { ...after({ ...DONE, leftRight: ON.leftRight }, pick(0, 7)) };
  const offered = after(begun, { kind: 'proposed', proposal: { id: 5, of: 7, side: 1, point: 17 } });
  const taken = after(offered, { kind: 'proposal-accepted', across: across(117) });
  expect(taken.pairs.slice(4)).toEqual([pair(5, 7, 17), pair(6, 107, 117)]);
  expect(after(taken, { kind: 'undo' }).pairs).toEqual(begun.pairs);
});

describe('names', () => {
  test('follow where they tell left from right', () => {
    const names = (state: State): string[] => state.pairs.map(({ label }) => label);
    const label = (id: number, text: string): Event => ({ kind: 'pair-labelled', id, label: text });
    const named = after(TWO, label(1, 'left ear'));
    expect(names(named)).toEqual(['left ear', 'right ear']);
    expect(names(after(named, label(2, 'right eye')))).toEqual(['left eye', 'right eye']);
    expect(names(after(named, { kind: 'undo' }))).toEqual(['', '']);
    expect(names(after(TWO, label(1, 'ear')))).toEqual(['ear', '']);
    expect(names(after(TWO, label(2, 'horn'), label(1, 'left ear')))).toEqual(['left ear', 'horn']);
    expect(names(after(TWO, { kind: 'left-right', isOn: false }, label(1, 'left ear')))).toEqual(['left ear', '']);
  });

  test.each([
    ['left ear', 'right ear'],
    ['Right front hoof', 'Left front hoof'],
    ['EAR LEFT', 'EAR RIGHT'],
    ['ear_L', 'ear_R'],
    ['ear.r', 'ear.l'],
    ['L knee', 'R knee'],
    ['ear', null],
    ['cleft', null],
    ['L4 vertebra', null],
    ['', null],
  ])('%s is %s across', (name, other) => {
    expect(otherName(name)).toBe(other);
    if (other !== null) {
      expect(otherName(other)).toBe(name);
    }
  });
});

describe('planes', () => {
  test('leave work and map as they are', () => {
    const on = after(DONE, { kind: 'left-right', isOn: true }, { kind: 'plane', side: 0, plane: planeOf(CAT) });
    expect([on.pairs, on.history, isCurrent(on)]).toEqual([DONE.pairs, DONE.history, true]);
  });

  test('are used while the mode is on, of their own mesh, and where the best one fits or one was chosen', () => {
    const using = (plane: MeshPlane): unknown => planeInUse(after(ON, { kind: 'plane', side: 0, plane }), 0);
    expect(using(planeOf(CAT))).toBe(ANSWER.plane);
    expect(using(planeOf(CAT, { answer: { ...ANSWER, fits: false } }))).toBeNull();
    expect(using(planeOf(CAT, { choice: 'x', answer: { ...ANSWER, fits: false } }))).toBe(ANSWER.plane);
    expect(using(planeOf(CAT, { answer: null }))).toBeNull();
    expect(using(planeOf(CAT, { answer: 'awaited' }))).toBeNull();
    expect(planeInUse(after(ON, { kind: 'left-right', isOn: false }), 0)).toBeNull();
    expect(planeInUse(after(ON, { kind: 'mesh', side: 0, file: mesh('cow.off') }), 0)).toBeNull();
    // An answer that comes late, for a mesh that has been replaced, is ignored.
    expect(after(ON, { kind: 'plane', side: 0, plane: planeOf(mesh('cow.off')) })).toBe(ON);
  });

  test('go with their meshes to the other side', () => {
    const swapped = after(ON, { kind: 'swap-meshes' });
    expect(swapped.leftRight.planes.map((plane) => plane?.of)).toEqual([LION, CAT]);
  });

  test('tell what lies across from each point that is placed, and ask nothing else', () => {
    const mirror = vi.fn<Mirror>(() => across(9));
    const event: Event = { kind: 'point-picked', side: 0, point: 4 };
    expect(completed(ON, event, mirror)).toEqual({ ...event, across: across(9) });
    expect(mirror).toHaveBeenCalledExactlyOnceWith(0, 4);
    expect(completed(READY, event, mirror)).toBe(event);
    const given: Event = { ...event, across: null };
    expect(completed(ON, given, mirror)).toBe(given);
    const other: Event = { kind: 'pair-deleted', id: 1 };
    expect(completed(ON, other, mirror)).toBe(other);
    expect(mirror).toHaveBeenCalledTimes(1);
  });
});

describe('the planes of the meshes', () => {
  function opened(answer: PlaneAnswer | null): { readonly store: Store; readonly asked: string[]; readonly planes: Planes } {
    const store = new Store();
    const wishes: string[] = [];
    const reader = {
      ask: (question: { readonly wish: string }) => {
        wishes.push(question.wish);
        return Promise.resolve(JSON.stringify(answer));
      },
    } as unknown as FileReader;
    // Vertices whose numbers sum to nine are each other's mirror images.
    const mirror: Mirror = (side, point) => {
      const holder = store.state.pairs.find(({ points }) => points[side] === 9 - Number(point));
      return { ...across(0), pair: holder?.id ?? null };
    };
    const planes = new Planes(store, reader, mirror);
    const packed = (name: string): State['meshes'][0] => ({ ...mesh(name), mesh: { packed: () => new Uint8Array() } as never });
    store.dispatch(
      { kind: 'mesh', side: 0, file: packed('cat.off') ?? mesh('') },
      { kind: 'mesh', side: 1, file: packed('lion.off') ?? mesh('') },
      { kind: 'landmarks', file: { pairs: [[0, 10], [1, 11], [9, 12]] } },
    );
    return { store, asked: wishes, planes };
  }
  const settled = async (): Promise<void> => {
    await new Promise((resolve) => setTimeout(resolve, 0));
  };

  test('are asked for when the mode comes on, once for each mesh, and pairs that are there go together', async () => {
    const { store, asked: wishes } = opened(ANSWER);
    await settled();
    expect(wishes).toEqual([]);
    store.dispatch({ kind: 'left-right', isOn: true });
    await settled();
    expect(wishes).toEqual(['{"kind":"found"}', '{"kind":"found"}']);
    expect(store.state.leftRight.planes.map((plane) => plane?.answer)).toEqual([ANSWER, ANSWER]);
    expect(twinOf(store.state, 1)?.id).toBe(3);
    store.dispatch({ kind: 'left-right', isOn: false });
    store.dispatch({ kind: 'left-right', isOn: true });
    store.dispatch({ kind: 'swap-meshes' });
    await settled();
    expect(wishes).toHaveLength(2);
  });

  test('make suggestions go together that mirror each other, though they were not known to be alike', async () => {
    const { store } = opened(ANSWER);
    const rings = (): number[] => store.state.suggestions[0].map(({ point }) => point);
    store.dispatch({ kind: 'left-right', isOn: true });
    await settled();
    // Vertex 3 is the mirror image of vertex 6, and 4 of 5; 8 is that of vertex 1, which pair 2 has.
    store.dispatch({ kind: 'suggested', side: 0, suggestions: [3, 4, 5, 8].map((point) => suggestion(point, String(point))) });
    store.dispatch({ kind: 'point-picked', side: 0, point: 6, across: null });
    await settled();
    expect(rings()).toEqual([3, 4, 5, 8]);
    store.dispatch({ kind: 'point-picked', side: 0, point: 3, across: null });
    await settled();
    expect(twinOf(store.state, 4)?.id).toBe(5);
    expect(rings()).toEqual([4, 5, 8]);
    store.dispatch({ kind: 'suggestions-taken', side: 0 });
    await settled();
    expect([twinOf(store.state, 6)?.id, twinOf(store.state, 2)?.id]).toEqual([7, 8]);
  });

  test('make no pairs go together that come while places are suggested, but only those that are taken', async () => {
    const { store } = opened(ANSWER);
    store.dispatch({ kind: 'left-right', isOn: true });
    await settled();
    store.dispatch({ kind: 'suggested', side: 0, suggestions: [suggestion(2, 'A'), suggestion(5, 'B')] });
    store.dispatch({ kind: 'landmarks', file: { pairs: [[3, 10], [6, 11], [4, 12], [5, 13]] } });
    store.dispatch({ kind: 'point-picked', side: 0, point: 7, across: null });
    await settled();
    const twins = (): unknown[] => store.state.pairs.map(({ id, points }) => [points[0], twinOf(store.state, id)?.points[0]]).filter(([, twin]) => twin !== undefined);
    expect(twins()).toEqual([]);
    store.dispatch({ kind: 'point-picked', side: 0, point: 2, across: null });
    await settled();
    expect(twins()).toEqual([[7, 2], [2, 7]]);
  });

  test('remove the suggestion at whose place a partner stands', async () => {
    const { store } = opened(ANSWER);
    store.dispatch({ kind: 'left-right', isOn: true });
    await settled();
    store.dispatch({ kind: 'suggested', side: 0, suggestions: [suggestion(3, 'A'), suggestion(4, 'B')] });
    store.dispatch({ kind: 'point-picked', side: 0, point: 6, across: { ...across(30), pair: null } });
    await settled();
    expect(store.state.pairs).toHaveLength(5);
    expect(store.state.suggestions[0].map(({ letter }) => letter)).toEqual(['B']);
  });

  test('can be chosen: across an axis, or between the two points that were placed last', async () => {
    const { store, asked: wishes, planes } = opened(null);
    store.dispatch({ kind: 'left-right', isOn: true });
    await settled();
    planes.choose(1, 'z');
    planes.choose(0, 'pins');
    await settled();
    expect(wishes.slice(2)).toEqual(['{"kind":"axis","axis":2}', '{"kind":"points","points":[1,9]}']);
    expect(store.state.leftRight.planes.map((plane) => [plane?.choice, plane?.answer])).toEqual([
      ['pins', null],
      ['z', null],
    ]);
    // The plane that was found is remembered.
    planes.choose(0, 'found');
    expect([store.state.leftRight.planes[0]?.answer, wishes.length]).toEqual([null, 4]);
  });
});
