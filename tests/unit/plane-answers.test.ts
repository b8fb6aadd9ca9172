/** The mirror planes that the core finds for a mesh. */
import { beforeAll, expect, test } from 'vitest';
import type { PlaneAnswer } from '../../www/store/left-right.ts';
import type { MeshFile } from '../../www/store/work.ts';
import { buildDemo } from '../../www/wasm/page.js';
import { startModules } from './modules.ts';
import { meshFile, READER } from './reading.ts';

let horse: MeshFile;

beforeAll(() => {
  startModules();
  const demo = buildDemo('horse-cat');
  horse = meshFile({ name: 'horse.obj', bytes: demo?.source() ?? new Uint8Array() });
});

async function plane(wish: object): Promise<PlaneAnswer | null> {
  const answer = await READER.ask({ kind: 'plane', mesh: horse.mesh.packed(), wish: JSON.stringify(wish) }, null);
  return JSON.parse(answer) as PlaneAnswer | null;
}

test('the plane of a horse is found, and is the one across its z axis', async () => {
  const [found, given] = [await plane({ kind: 'found' }), await plane({ kind: 'axis', axis: 2 })];
  expect(found?.fits).toBe(true);
  expect(found?.misfit).toBeLessThan(0.001);
  expect(Math.abs(found?.plane.normal[2] ?? 0)).toBeCloseTo(1, 5);
  expect(given?.misfit).toBeCloseTo(found?.misfit ?? 1, 3);
  const wrong = await plane({ kind: 'axis', axis: 0 });
  expect(wrong?.misfit).toBeGreaterThan(0.02);
});

test('the plane between two points lies in their middle, and between one and itself is none', async () => {
  const between = await plane({ kind: 'points', points: [0, 100] });
  expect(Math.hypot(...(between?.plane.normal ?? []))).toBeCloseTo(1, 12);
  expect(await plane({ kind: 'points', points: [7, 7] })).toBeNull();
  expect(await plane({ kind: 'points', points: [7, 9_999_999] })).toBeNull();
  expect(await plane({ kind: 'axis', axis: 3 })).toBeNull();
});
