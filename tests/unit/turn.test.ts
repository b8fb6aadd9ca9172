/** When the page turns a view by itself. */
import { beforeEach, expect, test, vi } from 'vitest';
import type { Side } from '../../www/landmarks.ts';
import { seeFoundAlike } from '../../www/app/turn.ts';
import type { Event } from '../../www/store/events.ts';
import { Store } from '../../www/store/store.ts';
import { MATCH, mesh, PICTURES } from './fixtures.ts';

let store = new Store();
const lookAsOther = vi.fn<(side: Side) => void>();

/** The sides that were turned by these events. */
async function turned(...events: readonly Event[]): Promise<Side[]> {
  lookAsOther.mockClear();
  store.dispatch(...events);
  await Promise.resolve();
  return lookAsOther.mock.calls.flat();
}

const SEARCH: Event = { kind: 'search-begun' };
const FOUND: Event = { kind: 'search-done', report: MATCH, pictures: PICTURES };

beforeEach(() => {
  store = new Store();
  seeFoundAlike(store, { lookAsOther });
  store.dispatch({ kind: 'ready', demos: [] });
  store.dispatch({ kind: 'mesh', side: 0, file: mesh('cat.obj') }, { kind: 'mesh', side: 1, file: mesh('lion.obj') });
});

test('the target is turned once where landmarks were found and none was there', async () => {
  expect(await turned(SEARCH)).toEqual([]);
  expect(await turned(FOUND)).toEqual([1]);
  expect(await turned({ kind: 'undo' })).toEqual([]);
});

test('views that the user has used to place a pair stay', async () => {
  store.dispatch({ kind: 'point-picked', side: 0, point: 0 });
  store.dispatch({ kind: 'point-picked', side: 1, point: 10 });
  store.dispatch(SEARCH);
  expect(await turned(FOUND)).toEqual([]);
});
