/** The run of the page, with a worker that only listens. */
import { beforeEach, expect, test, vi } from 'vitest';
import { Runner } from '../../www/app/run.ts';
import type { RunRequest, WarmUpRequest, WorkerMessage } from '../../www/compute/messages.ts';
import { wholePairs } from '../../www/store/order.ts';
import { shownPreview } from '../../www/store/preview.ts';
import { Store } from '../../www/store/store.ts';
import { fakeWorkers } from './fake-worker.ts';
import { DOUBT, mesh, OUTPUT, READY, SWAPPED } from './fixtures.ts';

const FakeWorker = fakeWorkers<WorkerMessage>();
type FakeWorker = InstanceType<typeof FakeWorker>;

const POINTS = wholePairs(READY).map(({ points }) => points);
const CORE = {} as WebAssembly.Module;
let store: Store;
let runner: Runner;

/** Starts the run; returns its worker. */
function started(): FakeWorker {
  runner.start();
  const worker = FakeWorker.made.at(-1);
  if (worker === undefined) {
    throw new Error('no worker was made');
  }
  return worker;
}

beforeEach(() => {
  FakeWorker.made = [];
  vi.stubGlobal('Worker', FakeWorker);
  vi.spyOn(console, 'error').mockReturnValue();
  store = new Store();
  runner = new Runner(store);
  runner.use(() => CORE);
  store.dispatch(
    { kind: 'ready', demos: [] },
    { kind: 'mesh', side: 0, file: mesh('cat.off') },
    { kind: 'mesh', side: 1, file: mesh('lion.off') },
    { kind: 'landmarks', file: { pairs: POINTS } },
  );
});

test('gets the meshes, landmarks and options of the page', () => {
  const request = started().posted[0] as RunRequest;
  const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
  expect([text(request.source), text(request.target)]).toEqual(['cat.off', 'lion.off']);
  expect(JSON.parse(request.landmarks)).toMatchObject({ pairs: POINTS });
  expect(request.options).toEqual(store.state.options);
  expect(request.module).toBe(CORE);
  expect(store.state.job.kind).toBe('running');
});

test('does not start twice, nor while the page is busy, nor without the core', () => {
  started();
  runner.start();
  expect(FakeWorker.made).toHaveLength(1);
  runner.cancel();
  store.dispatch({ kind: 'task-begun', task: { sentence: 'Reading…' } });
  runner.start();
  expect(FakeWorker.made).toHaveLength(1);
  new Runner(new Store()).start();
  expect(FakeWorker.made).toHaveLength(1);
});

test('brings what the worker says into the state, up to the map', () => {
  const worker = started();
  worker.says({ kind: 'finishable' });
  worker.says({ kind: 'found', findings: [SWAPPED] });
  worker.says({ kind: 'relaxes' });
  const places = new Float32Array(9);
  worker.says({ kind: 'preview', places });
  expect(shownPreview(store.state)).toBe(places);
  worker.says({ kind: 'progress', stage: 'relaxation', sentence: 'Relaxing the map', share: 0.5, residual: null, energy: 5 });
  expect(store.state).toMatchObject({ findings: [DOUBT], job: { finish: 'possible', energies: [[5]] } });
  runner.finish();
  expect(store.state.job).toMatchObject({ finish: 'asked' });
  worker.says({ kind: 'done', output: { ...OUTPUT, report: '{"warnings":["few"]}' } });
  expect(store.state).toMatchObject({ job: { kind: 'done' }, result: { report: { warnings: ['few'] } } });
  expect(worker.ended).toBe(true);
});

test('that fails says why', () => {
  started().says({ kind: 'failed', failure: { code: 'none', message: 'no map was found' } });
  expect(store.state).toMatchObject({ job: { kind: 'error' }, error: 'No map was found.' });
});

test('that is cancelled ends its worker and hears nothing more', () => {
  const worker = started();
  runner.cancel();
  expect(worker.ended).toBe(true);
  worker.says({ kind: 'done', output: OUTPUT });
  expect(store.state).toMatchObject({ job: { kind: 'idle' }, result: null });
});

test('is not made where it would make the same map again', () => {
  started().says({ kind: 'done', output: { ...OUTPUT, report: '{"warnings":[],"stopped_early":false}' } });
  runner.start();
  expect(FakeWorker.made).toHaveLength(1);
  expect(store.state.toast?.sentence).toMatch(/already/);
  store.dispatch({ kind: 'options', options: { method: 'thesis' } });
  started();
  expect(FakeWorker.made).toHaveLength(2);
});

test('ends the warming of the core, which does not begin during a run', () => {
  runner.warmUp('ball');
  const warmer = FakeWorker.made[0];
  expect((warmer?.posted[0] as WarmUpRequest).demo).toBe('ball');
  expect(warmer?.ended).toBe(false);
  started();
  expect(warmer?.ended).toBe(true);
  runner.warmUp('ball');
  expect(FakeWorker.made).toHaveLength(2);
});
