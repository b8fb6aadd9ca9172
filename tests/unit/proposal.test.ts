/** Places that the map proposes for half pairs: when there is one, and what accepts and drops it. */
import { describe, expect, test, vi } from 'vitest';
import { listenForHalves } from '../../www/app/propose.ts';
import type { Side, SurfacePoint } from '../../www/landmarks.ts';
import type { Event } from '../../www/store/events.ts';
import { proposed, questionOf } from '../../www/store/proposal.ts';
import type { Proposal, State } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { workOf } from '../../www/store/work.ts';
import { after, DONE, FOUR, mesh, OUTPUT, pair, READY, REPORT } from './fixtures.ts';

const pick = (side: Side, point: SurfacePoint): Event => ({ kind: 'point-picked', side, point });
const ACCEPT: Event = { kind: 'proposal-accepted' };
const PROPOSAL: Proposal = { id: 5, of: 7, side: 1, point: { face: 3, barycentric: [0.500_01, 0.249_96, 0.250_03] } };
const ROUNDED: SurfacePoint = { face: 3, barycentric: [0.5, 0.25, 0.25] };
/** A state with a map, where a point was clicked on the source and the map has proposed its image. */
const OFFERED = after(DONE, pick(0, 7), { kind: 'proposed', proposal: PROPOSAL });

describe('a proposal', () => {
  test('needs a half pair and a map of these meshes', () => {
    expect(questionOf(DONE)).toBeNull();
    expect(questionOf(after(READY, pick(0, 7)))).toBeNull();
    expect(questionOf(after(DONE, pick(1, 7)))).toMatchObject({ id: 5, side: 0, point: 7 });
    expect(questionOf(after(DONE, pick(0, 7), { kind: 'mesh', side: 1, file: mesh('horse.off') }))).toBeNull();
  });

  test('is taken in one step, rounded as a click is, and one step takes it back', () => {
    expect(proposed(OFFERED)).toBe(PROPOSAL);
    const taken = after(OFFERED, ACCEPT);
    expect(taken.pairs).toEqual([...FOUR, pair(5, 7, ROUNDED)]);
    expect(taken.history.past.length).toBe(OFFERED.history.past.length + 1);
    expect([taken.ui.selected, proposed(taken)]).toEqual([5, null]);
    const back = after(taken, { kind: 'undo' });
    expect(back.pairs).toBe(OFFERED.pairs);
    expect(after(back, { kind: 'redo' }).pairs).toBe(taken.pairs);
  });

  test('is gone after a click elsewhere, which makes the pair', () => {
    const placed = after(OFFERED, pick(1, 20));
    expect(placed.pairs.at(-1)).toEqual(pair(5, 7, 20));
    expect(proposed(placed)).toBeNull();
    expect(after(placed, ACCEPT)).toBe(placed);
  });

  test('that is dropped leaves the half pair', () => {
    const dropped = after(OFFERED, { kind: 'proposal-dropped' });
    expect([dropped.pairs, proposed(dropped)]).toEqual([OFFERED.pairs, null]);
    expect(after(dropped, ACCEPT)).toBe(dropped);
  });

  test('is of one pair and one point alone', () => {
    const moved = after(OFFERED, { kind: 'point-moved', id: 5, side: 0, point: 8, gesture: 1 });
    expect(proposed(moved)).toBeNull();
    const two = after(OFFERED, pick(0, 9));
    expect(proposed(two)).toBe(PROPOSAL);
    const other = after(two, { kind: 'pair-selected', id: 6 });
    expect([proposed(other), after(other, ACCEPT)]).toEqual([null, other]);
    // The other half pair gets its turn once the first one is complete.
    expect(questionOf(after(two, ACCEPT))).toMatchObject({ id: 6, point: 9 });
  });

  test('of a point that has a pair is refused with the number of the pair', () => {
    const refused = after({ ...OFFERED, proposal: { ...PROPOSAL, point: 12 } }, ACCEPT);
    expect(refused.error).toMatch(/target.*pair 3/);
    expect(refused.pairs).toBe(OFFERED.pairs);
  });

  test('that is dragged is placed in one step, named as such', () => {
    const move = (point: number): Event => ({ kind: 'point-moved', id: 5, side: 1, point, gesture: 1 });
    const dragged = after(OFFERED, move(30), move(31));
    expect(dragged.pairs.at(-1)).toEqual(pair(5, 7, 31));
    expect(dragged.history.past.at(-1)?.name).toBe('Place pair 5');
    expect(after(dragged, { kind: 'undo' }).pairs).toBe(OFFERED.pairs);
  });
});

/** A page with a map, and the questions to its views. */
function page(imageOf: (side: Side, point: SurfacePoint) => SurfacePoint | null): {
  store: Store;
  imageOf: ReturnType<typeof vi.fn>;
  shown: Proposal[];
  act: (...events: Event[]) => Promise<State>;
} {
  const store = new Store();
  const [cat, lion] = READY.meshes;
  if (cat === null || lion === null) {
    throw new Error('no meshes');
  }
  store.dispatch({ kind: 'mesh', side: 0, file: cat });
  store.dispatch({ kind: 'mesh', side: 1, file: lion });
  store.dispatch({ kind: 'run-started' });
  store.dispatch({ kind: 'run-done', output: OUTPUT, report: REPORT });
  const asked = vi.fn(imageOf);
  const shown: Proposal[] = [];
  listenForHalves(store, { imageOf: asked, bringIntoSight: (proposal) => shown.push(proposal) });
  const act = async (...events: Event[]): Promise<State> => {
    store.dispatch(...events);
    await Promise.resolve();
    return store.state;
  };
  return { store, imageOf: asked, shown, act };
}

describe('a half pair', () => {
  test('is answered by the map, from either side, and shown once', async () => {
    const { imageOf, shown, act } = page((_, point) => 100 + Number(point));
    const begun = await act(pick(0, 7));
    const proposal = proposed(begun);
    expect(proposal).toEqual({ id: 1, of: 7, side: 1, point: 107 });
    expect(imageOf).toHaveBeenCalledExactlyOnceWith(0, 7);
    // While the point is dragged the proposal follows, and no camera turns.
    const moved = await act({ kind: 'point-moved', id: 1, side: 0, point: 8, gesture: 1 });
    expect(proposed(moved)).toMatchObject({ of: 8, point: 108 });
    expect(shown).toEqual([proposal]);
    expect((await act(ACCEPT)).pairs).toEqual([pair(1, 8, 108)]);
    expect(proposed(await act(pick(1, 50)))).toEqual({ id: 2, of: 50, side: 0, point: 150 });
    expect(imageOf).toHaveBeenLastCalledWith(1, 50);
  });

  test('is asked about once: what was dropped does not come back by itself', async () => {
    const { imageOf, act } = page(() => 1);
    await act(pick(0, 7));
    await act({ kind: 'proposal-dropped' });
    const state = await act({ kind: 'pair-hovered', id: 1 });
    expect(proposed(state)).toBeNull();
    expect(imageOf).toHaveBeenCalledOnce();
  });

  test('comes with its proposal again when the pair is taken back', async () => {
    const { act } = page(() => 1);
    await act(pick(0, 7));
    await act(ACCEPT);
    expect(proposed(await act({ kind: 'undo' }))).toMatchObject({ id: 1, point: 1 });
  });

  test('has none where the map tells no place', async () => {
    const { shown, act } = page(() => null);
    const state = await act(pick(0, 7));
    expect([proposed(state), shown]).toEqual([null, []]);
  });

  test('whose place is on the source shows the source in its own shape', async () => {
    const { act } = page(() => 1);
    await act({ kind: 'style', style: { morph: 0.5 } });
    expect((await act(pick(0, 7))).ui.style.morph).toBe(0.5);
    expect((await act(pick(1, 2), pick(1, 8))).ui.style.morph).toBe(0);
  });

  test('is not answered late: the answer to an old question is left out', async () => {
    const { store, act } = page(() => 1);
    store.dispatch(pick(0, 7));
    const state = await act({ kind: 'undo' });
    expect(state.proposal).toBeNull();
  });
});

test('the work that is kept knows nothing of proposals', () => {
  expect(Object.keys(workOf(OFFERED))).not.toContain('proposal');
});
