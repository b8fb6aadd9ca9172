/** Demos that are opened with the core itself. */
import { beforeAll, beforeEach, expect, test, vi } from 'vitest';
import { openDemo } from '../../www/app/open.ts';
import type { Demo } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { demoList } from '../../www/wasm/page.js';
import { mesh } from './fixtures.ts';
import { READER } from './reading.ts';
import { startModules } from './modules.ts';

let demos: Demo[];
let store: Store;

beforeAll(() => {
  startModules();
  demos = JSON.parse(demoList()) as Demo[];
});

beforeEach(() => {
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => {
    queueMicrotask(draw);
    return 0;
  });
  store = new Store();
  store.dispatch({ kind: 'ready', demos });
});

test('a demo is one step, with its meshes and landmarks', async () => {
  const demo = demos.at(-1);
  expect(await openDemo(store, READER, demo?.id ?? '')).toBe(true);
  expect(store.state.demo).toBe(demo);
  expect(store.state.pairs.length).toBeGreaterThan(3);
  expect(store.state.pairs.map(({ number }) => number)).toEqual(store.state.pairs.map((_, index) => index + 1));
  expect(store.state.history.past.map(({ name }) => name)).toEqual([`Open the demo “${demo?.title ?? ''}”`]);
  expect(store.state.toast).toBeNull();
});

test('a demo gives way to a file that came meanwhile', async () => {
  const opened = openDemo(store, READER, demos.at(-1)?.id ?? '');
  const task = { sentence: 'Reading the files…' };
  store.dispatch({ kind: 'task-begun', task }, { kind: 'mesh', side: 0, file: mesh('cow.off') }, { kind: 'task-ended', task });
  expect(await opened).toBe(false);
  expect([store.state.demo, store.state.meshes[0]?.name]).toEqual([null, 'cow.off']);
});

test('a demo that there is not is named, and during a run none comes', async () => {
  expect(await openDemo(store, READER, 'teapot')).toBe(false);
  expect(store.state.error).toMatch(/no demo/);
  store.dispatch({ kind: 'run-started' });
  expect(await openDemo(store, READER, demos[0]?.id ?? '')).toBe(false);
  expect(store.state.error).toMatch(/being computed/);
});
