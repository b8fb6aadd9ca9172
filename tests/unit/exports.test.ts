/** Which files can be saved. */
import { expect, test, vi } from 'vitest';
import { exportsOf } from '../../www/panels/exports.ts';
import type { State } from '../../www/store/state.ts';
import { after, DONE, mesh } from './fixtures.ts';

function titles(state: State): string[] {
  return exportsOf(state, { saveMadeFile: vi.fn(), saveWrapped: vi.fn(), saveLandmarks: vi.fn() }).map(({ title }) => title);
}

test('a map’s files can be saved while its meshes are on the page', () => {
  expect(titles(DONE)).toEqual(expect.arrayContaining(['Textured mesh', 'All numbers', 'Landmarks']));
  const others = after(DONE, { kind: 'mesh', side: 1, file: mesh('horse.off') });
  expect(titles(others)).toEqual([]);
  expect(titles(after(others, { kind: 'undo' }))).toEqual(titles(DONE));
});
