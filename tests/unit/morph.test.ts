/** When the way to the target's shape is computed, and what happens to the answer. */
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { bendMorphs } from '../../www/app/morph.ts';
import type { RunOutput } from '../../www/compute/messages.ts';
import type { SavedAnswer, SavedRequest, Way } from '../../www/compute/saved-messages.ts';
import { Store } from '../../www/store/store.ts';
import { Picture } from '../../www/viewer/picture.ts';
import type { Viewer } from '../../www/wasm/page.js';
import { fakeWorkers } from './fake-worker.ts';
import { mesh, OUTPUT, REPORT, RESULT } from './fixtures.ts';

const FakeWorker = fakeWorkers<SavedAnswer>();
const CORE = {} as WebAssembly.Module;
const WAY: Way = { laid: new Float32Array(16), range: 1, bends: new Int16Array(36) };
const MADE: RunOutput = { ...OUTPUT, map: new Uint8Array([1]), faces: [new Uint32Array(1), new Uint32Array(1)] };

const take = vi.fn();
let store = new Store();
let want = (): void => undefined;

/** A page with this map. */
function pageWith(output: RunOutput): Store {
  const made = new Store();
  made.dispatch({ kind: 'mesh', side: 0, file: mesh('cat.off') });
  made.dispatch({ kind: 'mesh', side: 1, file: mesh('lion.off') });
  made.dispatch({ kind: 'run-started' });
  made.dispatch({ kind: 'run-done', output, report: REPORT });
  return made;
}

async function settled(): Promise<void> {
  await new Promise((resolve) => {
    setTimeout(resolve, 0);
  });
}

async function morph(share: number): Promise<void> {
  store.dispatch({ kind: 'style', style: { morph: share } });
  await settled();
}

/** The requests to the last worker. */
function asked(): readonly SavedRequest[] {
  return (FakeWorker.made.at(-1)?.posted ?? []) as readonly SavedRequest[];
}

async function answer(way: Way | null): Promise<void> {
  const worker = FakeWorker.made.at(-1);
  worker?.says({ kind: 'opened', id: 0, opened: null });
  await settled();
  const failure = { code: 'morph', message: 'the map goes to the mirror image', side: null };
  worker?.says(way === null ? { kind: 'failed', id: 1, failure } : { kind: 'way', id: 1, way });
  await settled();
}

beforeEach(() => {
  vi.stubGlobal('Worker', FakeWorker);
  FakeWorker.made = [];
  take.mockClear();
  store = pageWith(MADE);
  want = bendMorphs(store, () => CORE, take);
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

test('the way is asked for when it is first shown, once', async () => {
  await morph(0);
  expect(FakeWorker.made).toHaveLength(0);
  await morph(0.5);
  want();
  await morph(0.7);
  expect(FakeWorker.made).toHaveLength(1);
  await answer(WAY);
  expect(asked().map(({ kind }) => kind)).toEqual(['open', 'way']);
  expect(asked()[1]).toMatchObject({ points: { triangles: OUTPUT.triangles, source: OUTPUT.sides[0].positions } });
  expect(take.mock.calls).toEqual([[MADE, WAY]]);
  expect(FakeWorker.made[0]?.ended).toBe(true);
  await morph(0.9);
  expect(FakeWorker.made).toHaveLength(1);
});

test('a way that comes after its map has gone is dropped, and asked for again with the map', async () => {
  want();
  await settled();
  store.dispatch({ kind: 'mesh', side: 0, file: mesh('cow.off') });
  await answer(WAY);
  expect(take).not.toHaveBeenCalled();
  store.dispatch({ kind: 'undo' });
  want();
  await settled();
  await answer(WAY);
  expect(take.mock.calls).toEqual([[MADE, WAY]]);
});

test('without a map file, and where there is no way, lines stay straight and nothing is said', async () => {
  const warned = vi.spyOn(console, 'warn').mockReturnValue();
  store = pageWith({ ...OUTPUT, map: null });
  bendMorphs(store, () => CORE, take);
  await morph(0.5);
  expect(FakeWorker.made).toHaveLength(0);

  store = pageWith(MADE);
  bendMorphs(store, () => CORE, take);
  await morph(0.5);
  await answer(null);
  expect(take).not.toHaveBeenCalled();
  expect(store.state.error).toBeNull();
  expect(warned).toHaveBeenCalledOnce();
  await morph(0.6);
  expect(FakeWorker.made).toHaveLength(1);
});

test('triangles that went straight are brought anew, and a new renderer is told the way again', () => {
  const told: string[] = [];
  const listening = new Proxy(
    {},
    {
      get: (_, name) => () => {
        told.push(String(name));
      },
    },
  );
  const viewer = listening as unknown as Viewer;
  const picture = new Picture();
  picture.take(viewer, { ...RESULT, output: MADE }, null);
  picture.morph(viewer, 0.5);
  picture.takeWay(viewer, MADE, WAY);
  picture.morph(viewer, 0.6);
  expect(told).toEqual(['clearResult', 'setOverlay', 'setMorph', 'setWay', 'setOverlay', 'setMorph']);
  told.length = 0;
  picture.take(viewer, { ...RESULT, output: MADE }, null);
  picture.morph(viewer, 0.5);
  expect(told).toEqual(['clearResult', 'setWay', 'setOverlay', 'setMorph']);
  told.length = 0;
  // The points of another map move straight.
  picture.take(viewer, RESULT, null);
  picture.morph(viewer, 0.5);
  expect(told).toEqual(['clearResult', 'setOverlay', 'setMorph']);
});
