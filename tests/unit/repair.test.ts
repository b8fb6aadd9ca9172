/** What a finding asks for is done. */
import { beforeEach, expect, test, vi } from 'vitest';
import { repair } from '../../www/app/repair.ts';
import { Runner } from '../../www/app/run.ts';
import type { Finding } from '../../www/report.ts';
import { Store } from '../../www/store/store.ts';
import { pair, READY, SWAPPED } from './fixtures.ts';

let store: Store;
let runner: Runner;
const looked = vi.fn<(index: number) => void>();

beforeEach(() => {
  looked.mockReset();
  store = new Store();
  runner = new Runner(store);
  const pairs = READY.pairs.map(({ points }) => points);
  store.dispatch({ kind: 'ready', demos: [] }, { kind: 'landmarks', file: { pairs } }, { kind: 'run-started' });
});

test('swapped pairs get each other’s target, and the run with the old ones ends', () => {
  repair(store, runner, looked, SWAPPED);
  expect(store.state.pairs.slice(0, 2)).toEqual([pair(0, 11), pair(1, 10)]);
  expect(store.state.job).toEqual({ kind: 'idle' });
});

test('limbs are marked by rings of their side; the run goes on', () => {
  const limbs: Finding = { ...SWAPPED, kind: 'unmarked_limbs', repair: 'mark', side: 1, vertices: [40, 50] };
  repair(store, runner, looked, limbs);
  expect(store.state.suggestions[0]).toEqual([]);
  expect(store.state.suggestions[1]).toMatchObject([
    { point: 40, letter: 'A' },
    { point: 50, letter: 'B' },
  ]);
  expect(store.state.job.kind).toBe('running');
});

test('a doubtful pair is looked at', () => {
  repair(store, runner, looked, { ...SWAPPED, kind: 'misplaced', repair: 'check', pairs: [3] });
  expect(looked.mock.calls).toEqual([[3]]);
  expect(store.state.job.kind).toBe('running');
});
