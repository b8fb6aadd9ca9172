/** The store calls its listeners at changes. */
import { expect, test } from 'vitest';
import type { State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { DEMO } from './fixtures.ts';

test('several events are one change, heard by every listener in the order they came', () => {
  const store = new Store();
  const heard: [string, State, State][] = [];
  for (const name of ['first', 'second']) {
    store.subscribe((state, previous) => {
      heard.push([name, state, previous]);
    });
  }
  store.dispatch({ kind: 'ready', demos: [DEMO] }, { kind: 'error', sentence: 'Something failed.' });
  expect(store.state).toMatchObject({ ready: true, demos: [DEMO], error: 'Something failed.' });
  expect(heard).toEqual([
    ['first', store.state, INITIAL],
    ['second', store.state, INITIAL],
  ]);
});

test('an event that changes nothing is not heard', () => {
  const store = new Store();
  store.subscribe(() => {
    expect.unreachable();
  });
  store.dispatch({ kind: 'undo' });
  expect(store.state).toBe(INITIAL);
});
