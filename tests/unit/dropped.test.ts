/** Files that are dropped one after the other, faster than they are read. */
import { beforeAll, beforeEach, expect, test, vi } from 'vitest';
import { Dropped } from '../../www/app/dropped.ts';
import { leaveTask } from '../../www/app/task.ts';
import { Store } from '../../www/store/store.ts';
import { buildDemo } from '../../www/wasm/page.js';
import { READER } from './reading.ts';
import { startModules } from './modules.ts';

let store: Store;
let own: Record<'source' | 'target' | 'landmarks' | 'bad', File>;

beforeAll(() => {
  startModules();
  const demo = buildDemo('sphere-tetrahedron');
  if (demo === undefined) {
    throw new Error('no demo');
  }
  const landmarks = JSON.parse(new TextDecoder().decode(demo.landmarks())) as object;
  const file = (name: string, bytes: BlobPart): File => new File([bytes], name);
  own = {
    source: file('ball.obj', demo.source() as Uint8Array<ArrayBuffer>),
    target: file('tetrahedron.obj', demo.target() as Uint8Array<ArrayBuffer>),
    landmarks: file('pairs.json', JSON.stringify({ ...landmarks, source: 'ball.obj', target: 'tetrahedron.obj' })),
    bad: file('bad.obj', 'v 0 0 x'),
  };
});

beforeEach(() => {
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => {
    queueMicrotask(draw);
    return 0;
  });
  store = new Store();
  store.dispatch({ kind: 'ready', demos: [] });
});

/** The opener of the files of the page. */
function opener(): Dropped {
  const unasked = (): never => {
    throw new Error('nobody asks for this');
  };
  return new Dropped(store, {
    links: { waits: false, cancel: unasked, take: unasked },
    reader: READER,
    maps: { open: unasked, openOfProject: unasked },
  });
}

/** Drops files one by one, without waiting for any. */
async function drop(...files: readonly (readonly [File, 0 | 1 | null])[]): Promise<void> {
  const dropped = opener();
  await Promise.all(files.map(([file, side]) => dropped.open([file], side)));
}

function names(): (string | undefined)[] {
  return store.state.meshes.map((mesh) => mesh?.name);
}

test('none is lost, in whatever order they come', async () => {
  const { source, target, landmarks } = own;
  const all = [[source, 0], [target, 1], [landmarks, null]] as const;
  for (const order of [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 1, 0]]) {
    store = new Store();
    store.dispatch({ kind: 'ready', demos: [] });
    await drop(...order.map((k) => all[k] ?? all[0]));
    expect(names(), String(order)).toEqual(['ball.obj', 'tetrahedron.obj']);
    expect(store.state.pairs.length, String(order)).toBeGreaterThan(3);
    expect(store.state.job.kind).toBe('idle');
    expect(store.state.error).toBeNull();
  }
});

test('what was refused among them stays told', async () => {
  await drop([own.bad, 0], [own.target, 1]);
  expect(names()).toEqual([undefined, 'tetrahedron.obj']);
  expect(store.state.error).toContain('bad.obj');
  await drop([own.bad, 0], [own.bad, 1]);
  expect(store.state.error?.match(/bad\.obj/g)?.length).toBeGreaterThan(0);
  // The error stays until something else is opened.
  await drop([own.source, 0]);
  expect(store.state.error).toBeNull();
});

test('a file that is left while it is read is left out alone', async () => {
  const dropped = drop([own.source, 0], [own.target, 1]);
  leaveTask(store);
  await dropped;
  expect(names()).toEqual([undefined, 'tetrahedron.obj']);
});

test('a file that never comes to its end, once it is left, holds up no other', async () => {
  const endless = new File(['v 0 0 0'], 'endless.obj');
  endless.arrayBuffer = () => new Promise(() => undefined);
  const dropped = drop([endless, 0], [own.target, 1]);
  leaveTask(store);
  await dropped;
  expect(names()).toEqual([undefined, 'tetrahedron.obj']);
});

test('what breaks off holds up no other', async () => {
  const places = {
    links: { waits: false, cancel: vi.fn(), take: vi.fn() },
    reader: READER,
    maps: { open: () => Promise.reject(new Error('broken')), openOfProject: vi.fn() },
  };
  // Any unexpected failure while the first file is opened.
  const spy = vi.spyOn(store, 'dispatch').mockImplementationOnce(() => {
    throw new Error('broken');
  });
  const dropped = new Dropped(store, places);
  const first = dropped.open([own.source], 0);
  const second = dropped.open([own.target], 1);
  await expect(first).rejects.toThrow('broken');
  spy.mockRestore();
  await second;
  expect(names()).toEqual([undefined, 'tetrahedron.obj']);
});

test('something else that is begun meanwhile was wanted last', async () => {
  const dropped = drop([own.source, 0], [own.target, 1]);
  const task = { sentence: 'Building the demo…' };
  store.dispatch({ kind: 'task-begun', task });
  await dropped;
  expect(names()).toEqual([undefined, undefined]);
  store.dispatch({ kind: 'task-ended', task });
});

test('files that come before the page can open any wait for it to begin', async () => {
  store = new Store();
  const dropped = opener();
  expect(dropped.areWaiting).toBe(false);
  const early = [dropped.open([own.landmarks], null), dropped.open([own.target], 1)];
  expect(dropped.areWaiting).toBe(true);
  store.dispatch({ kind: 'ready', demos: [] });
  // This one comes when the page can open files, but has not begun: it waits for the earlier ones.
  const late = dropped.open([own.source], 0);
  expect(store.state.job.kind).toBe('idle');
  dropped.begin();
  expect(dropped.areWaiting).toBe(false);
  await Promise.all([...early, late]);
  expect(names()).toEqual(['ball.obj', 'tetrahedron.obj']);
  expect(store.state.pairs.length).toBeGreaterThan(3);
  expect(store.state.error).toBeNull();
});

test('a page on which nothing waits begins without any file', async () => {
  const dropped = opener();
  dropped.begin();
  await dropped.open([own.source], 0);
  expect(names()).toEqual(['ball.obj', undefined]);
});
