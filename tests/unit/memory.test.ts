/** Whether a map fits into the memory that a page can have. */
import { expect, test } from 'vitest';
import { expectedMemory, mayExceedMemory, MOST_MEMORY } from '../../www/store/memory.ts';
import { canRun } from '../../www/store/readiness.ts';
import type { State } from '../../www/store/state.ts';
import { mesh, READY } from './fixtures.ts';

const of = (source: number, target: number): State => ({ ...READY, meshes: [mesh('a.obj', source), mesh('b.obj', target)] });

test('memory is foretold from the triangles of both meshes', () => {
  expect(expectedMemory({ ...READY, meshes: [mesh('a.obj', 1e9), null] })).toBe(0);
  const [small, large] = [expectedMemory(of(20_000, 20_000)), expectedMemory(of(20_000, 1_020_000))];
  // The module took 355 MiB for 111,568 triangles.
  expect(expectedMemory(of(55_784, 55_784))).toBeGreaterThan(355 * 2 ** 20);
  expect(large - small).toBe(4096e6);
});

test('meshes of more than a million triangles are told of, and may be tried all the same', () => {
  expect(mayExceedMemory(of(328_000, 328_000))).toBe(false);
  expect(mayExceedMemory(of(600_000, 600_000))).toBe(true);
  expect(expectedMemory(of(515_000, 515_000)) < MOST_MEMORY).toBe(true);
  expect(canRun(of(600_000, 600_000))).toBe(true);
});
