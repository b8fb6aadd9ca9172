/** The repairs that findings suggest. */
import { beforeEach, expect, test, vi } from 'vitest';
import { repair } from '../../www/app/repair.ts';
import { Runner } from '../../www/app/run.ts';
import type { Doubt } from '../../www/store/state.ts';
import { wholePairs } from '../../www/store/order.ts';
import { Store } from '../../www/store/store.ts';
import { DOUBT, pair, READY } from './fixtures.ts';
import { READER } from './reading.ts';

let store: Store;
let runner: Runner;
const looked = vi.fn<(id: number) => void>();

beforeEach(() => {
  looked.mockReset();
  store = new Store();
  runner = new Runner(store);
  const pairs = wholePairs(READY).map(({ points }) => points);
  store.dispatch({ kind: 'ready', demos: [] }, { kind: 'landmarks', file: { pairs } }, { kind: 'run-started' });
});

test('swapped pairs get each other’s target, and the run with the old ones ends', () => {
  repair(store, { runner, reader: READER, lookAtPair: looked }, DOUBT);
  expect(store.state.pairs.slice(0, 2)).toEqual([pair(1, 0, 11), pair(2, 1, 10)]);
  expect(store.state.job).toEqual({ kind: 'idle' });
});

test('limbs are marked by rings of their side; the run goes on', () => {
  const limbs: Doubt = { ...DOUBT, kind: 'unmarked_limbs', repair: 'mark', side: 1, vertices: [40, 50] };
  repair(store, { runner, reader: READER, lookAtPair: looked }, limbs);
  expect(store.state.suggestions[0]).toEqual([]);
  expect(store.state.suggestions[1]).toMatchObject([
    { point: 40, letter: 'A' },
    { point: 50, letter: 'B' },
  ]);
  expect(store.state.job.kind).toBe('running');
});

test('a doubtful pair is looked at', () => {
  repair(store, { runner, reader: READER, lookAtPair: looked }, { ...DOUBT, kind: 'misplaced', repair: 'check', pairs: [3], ids: [4] });
  expect(looked.mock.calls).toEqual([[4]]);
  expect(store.state.ui.selected).toBe(4);
  expect(store.state.job.kind).toBe('running');
});
