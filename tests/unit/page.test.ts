/** What the page's parts derive from the state: the steps, the fit of pairs, and what a browser remembers. */
import { describe, expect, test } from 'vitest';
import type { LandmarkFile } from '../../www/landmarks.ts';
import { fitsOf } from '../../www/panels/fits.ts';
import { reason } from '../../www/panels/main-action.tsx';
import { documentName, meshName } from '../../www/panels/names.ts';
import { runningSentence } from '../../www/panels/progress.ts';
import { remembered } from '../../www/panels/shell.ts';
import { markOf, stepAfter, STEPS } from '../../www/panels/steps.ts';
import { INITIAL } from '../../www/store/state.ts';
import { after, DEMO, DONE, mesh, OPENED, pair, READY, RUNNING, SWAPPED } from './fixtures.ts';

describe('a step', () => {
  const marks = (state: typeof READY): string[] => STEPS.map((step) => markOf(state, step));

  test('tells how far it is', () => {
    expect(marks(INITIAL)).toEqual(['empty', 'empty', 'empty', 'empty', 'empty']);
    expect(marks(READY)).toEqual(['done', 'done', 'ready', 'empty', 'empty']);
    expect(marks(DONE)).toEqual(['done', 'done', 'done', 'ready', 'ready']);
    expect(markOf({ ...READY, job: RUNNING }, 'map')).toBe('running');
  });

  test('is outdated as long as the map is', () => {
    const changed = after(DONE, { kind: 'pair-deleted', id: 4 });
    expect(markOf(changed, 'map')).toBe('outdated');
    expect(markOf(changed, 'use')).toBe('outdated');
    expect(markOf(changed, 'landmarks')).toBe('ready');
    expect(markOf(after(changed, { kind: 'undo' }), 'map')).toBe('done');
  });

  test('begins anew where the map is of other meshes, until they are back', () => {
    const pairs = DONE.pairs.map(({ points }) => points);
    const other = after(DONE, { kind: 'mesh', side: 0, file: mesh('a') }, { kind: 'mesh', side: 1, file: mesh('b') }, { kind: 'landmarks', file: { pairs } as LandmarkFile });
    expect(marks(other)).toEqual(['done', 'done', 'ready', 'empty', 'empty']);
    expect(reason(other)).toBe('With 4 landmark pairs.');
    const back = after(other, { kind: 'undo' }, { kind: 'undo' }, { kind: 'undo' });
    expect(marks(back)).toEqual(marks(DONE));
    expect(reason(back)).toBe('The map shown is current.');
  });

  test('asks to look at doubtful landmarks', () => {
    const found = after({ ...READY, job: RUNNING }, { kind: 'run-found', findings: [SWAPPED] });
    expect(markOf(found, 'landmarks')).toBe('outdated');
  });
});

test('a run that is to finish tells of its best map only once it has one', () => {
  expect(runningSentence(RUNNING)).toBe('Starting…');
  expect(runningSentence({ ...RUNNING, finish: 'asked' })).toBe('Finishing as soon as there is a map: starting…');
  expect(runningSentence({ ...RUNNING, finish: 'asked', energies: [[6]] })).toBe('Finishing with the best map so far: starting…');
});

describe('a step opens by itself', () => {
  test('when both meshes are there', () => {
    const first = after(INITIAL, { kind: 'mesh', side: 0, file: mesh('a') });
    const second = after(first, { kind: 'mesh', side: 1, file: mesh('b') });
    expect(stepAfter(first, INITIAL)).toBeNull();
    expect(stepAfter(second, first)).toBe('landmarks');
    expect(stepAfter(after(second, { kind: 'undo' }), second)).toBeNull();
  });

  test('when a landmark file comes to them, unless the user is in the list', () => {
    const meshes = after(INITIAL, { kind: 'mesh', side: 0, file: mesh('a') }, { kind: 'mesh', side: 1, file: mesh('b') });
    const file = { pairs: [[0, 1], [2, 3], [4, 5], [6, 7]] as const };
    const marked = after(meshes, { kind: 'landmarks', file });
    expect(stepAfter(marked, meshes)).toBe('map');
    const inList = after(meshes, { kind: 'ui', ui: { step: 'landmarks' } });
    expect(stepAfter(after(inList, { kind: 'landmarks', file }), inList)).toBeNull();
  });

  test('when a map comes from a file, but not when it is there already', () => {
    const opened = after(READY, { kind: 'map-opened', map: OPENED });
    expect(stepAfter(opened, READY)).toBe('map');
    expect(stepAfter(after(opened, { kind: 'pair-deleted', id: 4 }), opened)).toBeNull();
  });

  test('when a run starts, but not when meshes change their places', () => {
    expect(stepAfter(after(READY, { kind: 'run-started' }), READY)).toBe('map');
    expect(stepAfter(after(READY, { kind: 'swap-meshes' }), READY)).toBeNull();
  });
});

test('a pair fits when a run has looked at it as it is', () => {
  expect([...fitsOf(READY).values()]).toEqual(['new', 'new', 'new', 'new']);
  expect([...fitsOf(DONE).values()]).toEqual(['fits', 'fits', 'fits', 'fits']);
  const moved = after(DONE, { kind: 'point-moved', id: 2, side: 1, point: 99, gesture: 1 });
  expect(fitsOf(moved).get(2)).toBe('new');
  expect(fitsOf(moved).get(1)).toBe('fits');
  expect(fitsOf({ ...DONE, pairs: [pair(9, 5, null)] }).get(9)).toBe('missing');
  const found = after({ ...READY, job: RUNNING }, { kind: 'run-found', findings: [SWAPPED] });
  expect([...fitsOf(found).values()]).toEqual(['doubtful', 'doubtful', 'new', 'new']);
});

test('meshes are called by their files, those of a demo by their sides', () => {
  const named = { ...READY, demo: null, meshes: [mesh('cat.off'), mesh('lion.v2.off')] as const };
  expect([meshName(named, 0), meshName(named, 1)]).toEqual(['cat', 'lion.v2']);
  expect(documentName(named)).toBe('cat → lion.v2');
  expect(documentName({ ...named, demo: DEMO })).toBe('Ball');
  expect(meshName({ ...named, demo: DEMO }, 0)).toBe('source');
  expect(documentName(INITIAL)).toBe('No meshes yet');
});

test('of what a browser stored only what is sound is taken', () => {
  expect(remembered('{"split":0.25,"theme":"dark"}')).toEqual({ split: 0.25, theme: 'dark' });
  expect(remembered('{"split":7,"theme":"pink","more":1}')).toEqual({});
  for (const text of [null, '', 'null', '7', '[]', '{', '{"split":"wide"}']) {
    expect(remembered(text)).toEqual({});
  }
});
