/** Tasks that keep the page busy. */
import { beforeEach, describe, expect, test, vi } from 'vitest';
import { perform, performBeside } from '../../www/app/task.ts';
import { FileRefused } from '../../www/files.ts';
import { Store } from '../../www/store/store.ts';

let store: Store;

beforeEach(() => {
  store = new Store();
  // Every frame is drawn at once.
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => {
    queueMicrotask(draw);
    return 0;
  });
});

test('is told while it lasts, and is over afterwards', async () => {
  const told: unknown[] = [];
  const work = perform(store, 'Reading…', () => 7, (prepared) => told.push([prepared, store.state.job]));
  expect(store.state.job).toMatchObject({ kind: 'busy', task: { sentence: 'Reading…' } });
  await work;
  expect(told).toEqual([[7, expect.objectContaining({ kind: 'busy' })]]);
  expect(store.state.job).toEqual({ kind: 'idle' });
});

test('is left out where later work has begun, whichever is ready first', async () => {
  const done: string[] = [];
  let release = (): void => undefined;
  const slow = perform(store, 'Slow…', () => new Promise<void>((resolve) => (release = resolve)), () => done.push('slow'));
  const quick = perform(store, 'Quick…', () => null, () => done.push('quick'));
  await quick;
  release();
  await slow;
  expect(done).toEqual(['quick']);
  expect(store.state.job).toEqual({ kind: 'idle' });
});

test('that is left tells its preparation, and neither works nor says why it failed', async () => {
  const done: string[] = [];
  let left: AbortSignal | null = null;
  const prepare = (signal: AbortSignal): Promise<never> => {
    left = signal;
    return new Promise((_, reject) => {
      signal.addEventListener('abort', () => {
        reject(new Error('left'));
      });
    });
  };
  const outcome = perform(store, 'Reading…', prepare, () => done.push('worked'));
  expect(left).toMatchObject({ aborted: false });
  const { job } = store.state;
  if (job.kind !== 'busy') {
    throw new Error('it is not told');
  }
  store.dispatch({ kind: 'task-ended', task: job.task });
  expect(left).toMatchObject({ aborted: true });
  expect(await outcome).toBe('left-out');
  expect([done, store.state.error, store.state.job]).toEqual([[], null, { kind: 'idle' }]);
});

test('that is over is told of nothing any more', async () => {
  let signal: AbortSignal | null = null;
  const outcome = await perform(store, 'Reading…', (given) => (signal = given), () => undefined);
  store.dispatch({ kind: 'error', sentence: 'Something else.' });
  expect([outcome, signal]).toEqual(['done', expect.objectContaining({ aborted: false })]);
});

test('does not end later work', async () => {
  let release = (): void => undefined;
  const early = perform(store, 'Early…', () => null, () => undefined);
  const late = perform(store, 'Late…', () => new Promise<void>((resolve) => (release = resolve)), () => undefined);
  await early;
  expect(store.state.job).toMatchObject({ kind: 'busy', task: { sentence: 'Late…' } });
  release();
  await late;
});

const REFUSED = new FileRefused('cat.off is empty.');
const nothing = (): void => undefined;
const refuse = (): never => {
  throw REFUSED;
};

test.each([
  ['in its preparation', refuse, nothing],
  ['later in its preparation', () => Promise.reject(REFUSED), nothing],
  ['itself', nothing, refuse],
])('that fails %s is over and says why', async (_, prepare, work) => {
  await perform(store, 'Reading…', prepare, work);
  expect(store.state).toMatchObject({ job: { kind: 'idle' }, error: 'cat.off is empty.' });
});

describe('what is made beside the page’s work', () => {
  const RUN = { kind: 'run-started' } as const;

  test('is made at rest as a task of its own', async () => {
    const used: unknown[] = [];
    const made = performBeside(store, 'Packing…', () => Promise.resolve(7), (prepared) => used.push(prepared));
    expect(store.state.job).toMatchObject({ kind: 'busy', task: { sentence: 'Packing…' } });
    await made;
    expect([used, store.state.job]).toEqual([[7], { kind: 'idle' }]);
  });

  test('leaves a run and a task as they are, and is used all the same', async () => {
    const used: unknown[] = [];
    for (const begin of [RUN, { kind: 'task-begun', task: { sentence: 'Reading…' } } as const]) {
      store = new Store();
      store.dispatch(begin);
      const { job } = store.state;
      await performBeside(store, 'Packing…', () => Promise.resolve(begin.kind), (prepared) => used.push(prepared));
      expect(store.state.job).toBe(job);
    }
    expect(used).toEqual(['run-started', 'task-begun']);
  });

  test('says why it fails, in its preparation or itself', async () => {
    for (const [prepare, use] of [[refuse, nothing], [() => Promise.reject(REFUSED), nothing], [() => Promise.resolve(), refuse]] as const) {
      store = new Store();
      store.dispatch(RUN);
      await performBeside(store, 'Packing…', async () => prepare(), use);
      expect(store.state).toMatchObject({ job: { kind: 'running' }, error: 'cat.off is empty.' });
    }
  });
});
