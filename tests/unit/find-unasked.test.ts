/** When the page begins to look for landmarks unasked. */
import { beforeEach, expect, test, vi } from 'vitest';
import { findUnasked } from '../../www/app/find-unasked.ts';
import type { Side } from '../../www/landmarks.ts';
import type { Event } from '../../www/store/events.ts';
import type { MeshFile } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { workOf } from '../../www/store/work.ts';
import { DEMO, mesh, pair } from './fixtures.ts';

let store = new Store();
const start = vi.fn();

/** The number of searches that have begun after these events, each dispatched in a turn of its own. */
async function begun(...events: readonly Event[]): Promise<number> {
  for (const event of events) {
    store.dispatch(event);
    await Promise.resolve();
  }
  return start.mock.calls.length;
}

const source = (faces = 20): Event => ({ kind: 'mesh', side: 0, file: mesh('cat.obj', faces) });
const target = (faces = 20): Event => ({ kind: 'mesh', side: 1, file: mesh('lion.obj', faces) });

beforeEach(() => {
  start.mockClear();
  store = new Store();
  findUnasked(store, start);
  store.dispatch({ kind: 'ready', demos: [DEMO] });
});

test('two meshes without landmarks are looked at once, and again when one of them is another', async () => {
  expect(await begun(source())).toBe(0);
  expect(await begun(target())).toBe(1);
  expect(await begun({ kind: 'toast', sentence: 'Hello', undo: false })).toBe(1);
  expect(await begun(source())).toBe(2);
});

test('a task is waited for', async () => {
  const task = { sentence: 'Reading…' };
  expect(await begun({ kind: 'task-begun', task }, source(), target())).toBe(0);
  expect(await begun({ kind: 'task-ended', task })).toBe(1);
});

test('nothing is looked for with landmarks, beside a demo, in large meshes, and after a step back', async () => {
  store.dispatch(source(), target(), { kind: 'point-picked', side: 0, point: 1 });
  expect(await begun()).toBe(0);
  expect(store.state.pairs).toEqual([pair(1, 1, null)]);

  store = new Store();
  findUnasked(store, start);
  store.dispatch({ kind: 'ready', demos: [DEMO] });
  const ofDemo = (side: Side): Event => ({ kind: 'mesh', side, file: { ...mesh('ball.obj'), ofDemo: { id: DEMO.id, side } } });
  store.dispatch(ofDemo(0), ofDemo(1), { kind: 'demo', demo: DEMO });
  expect(await begun()).toBe(0);
  // One mesh of the demo is still on the page.
  expect(await begun(source())).toBe(0);
  expect(await begun(target(200_000))).toBe(0);
  expect(await begun(target())).toBe(1);
  expect(await begun({ kind: 'undo' }, { kind: 'redo' })).toBe(1);
});

test('nothing is looked for on the swapped meshes of a demo that a link brings', async () => {
  const first: MeshFile = { ...mesh('ball.obj'), ofDemo: { id: DEMO.id, side: 1 } };
  const second: MeshFile = { ...mesh('ball.obj'), ofDemo: { id: DEMO.id, side: 0 } };
  const work = { ...workOf(store.state), meshes: [first, second] as const };
  expect(await begun({ kind: 'received', work, ui: {} })).toBe(0);
  expect(await begun({ kind: 'received', work: { ...work, meshes: [mesh('cat.obj'), mesh('lion.obj')] }, ui: {} })).toBe(1);
});
