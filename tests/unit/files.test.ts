/** Meshes and landmarks, read for the page by the core. */
import { beforeAll, expect, test } from 'vitest';
import { areMarksGood } from '../../www/files.ts';
import type { MeshFile } from '../../www/store/state.ts';
import { after, mesh, pair, READY } from './fixtures.ts';
import { fileAnswer } from '../../www/reading/file-answers.ts';
import { meshReading } from '../../www/reading/mesh-answers.ts';
import type { DemoFiles } from '../../www/reading/messages.ts';
import { meshFile, mirroredTarget } from './reading.ts';
import { startModules } from './modules.ts';

/** A tetrahedron with distinguishable corners, and a vertex before them that no face uses. */
const OBJ = 'v 9 9 9\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5\n';
let file: MeshFile;

beforeAll(() => {
  startModules();
  file = meshFile({ name: 'corner.obj', bytes: new TextEncoder().encode(OBJ) });
});

/** The position of a point of an OBJ file. */
function placeOf(obj: string, point: unknown): number[] {
  const lines = obj.split('\n');
  const vertices = lines.filter((line) => line.startsWith('v ')).map((line) => line.split(' ').slice(1).map(Number));
  if (typeof point === 'number') {
    return vertices[point] ?? [];
  }
  const { face, barycentric } = point as { face: number; barycentric: number[] };
  const corners = (lines.filter((line) => line.startsWith('f '))[face] ?? '').split(' ').slice(1).map((word) => vertices[parseInt(word) - 1] ?? []);
  return [0, 1, 2].map((axis) => barycentric.reduce((sum, weight, corner) => sum + weight * (corners[corner]?.[axis] ?? NaN), 0));
}

test('a mirror image carries the points of whole and half pairs to their mirrored places', () => {
  const pairs = [
    pair(1, 0, 2),
    pair(2, 5, null),
    pair(3, null, { face: 2, barycentric: [0.5, 0.3, 0.2] }),
    pair(4, { face: 1, barycentric: [0.2, 0.2, 0.6] }, 4, 'tip'),
  ];
  const event = mirroredTarget(file, pairs);
  if (event.kind !== 'mirrored') {
    throw new Error('another event came');
  }
  expect(event.file.name).toBe('corner (mirrored).obj');
  expect(event.points[1]).toBeNull();
  const image = new TextDecoder().decode(event.file.bytes);
  for (const index of [0, 2, 3]) {
    const [x = NaN, y = NaN, z = NaN] = placeOf(OBJ, pairs[index]?.points[1]);
    const place = placeOf(image, event.points[index]);
    expect(place.map((value, axis) => Math.abs(value - ([-x, y, z][axis] ?? NaN)))).toEqual([expect.closeTo(0), expect.closeTo(0), expect.closeTo(0)]);
  }
  const state = after({ ...READY, meshes: [mesh('cat.off'), file], pairs }, event);
  expect(areMarksGood({ meshes: [null, state.meshes[1]], pairs: state.pairs })).toBe(true);
});

test('a mirror image of a mesh without landmarks is one', () => {
  expect(mirroredTarget(file, [])).toMatchObject({ kind: 'mirrored', points: [] });
});

test.each([
  ['all are there', true, [pair(1, 1, 2), pair(2, 2, null), pair(3, null, 3), pair(4, { face: 0, barycentric: [0.2, 0.3, 0.5] }, 1)]],
  ['a vertex is not', false, [pair(1, 99, 1)]],
  ['a half pair’s vertex is not', false, [pair(1, null, 99)]],
  ['no face uses a vertex', false, [pair(1, 0, 1)]],
  ['a face is not', false, [pair(1, { face: 9, barycentric: [0.2, 0.3, 0.5] }, 1)]],
  ['weights do not sum to 1', false, [pair(1, { face: 1, barycentric: [0.2, 0.3, 0.6] }, 1)]],
  ['two pairs have one point', false, [pair(1, 1, 2), pair(2, 1, null)]],
] as const)('marks are good where %s: %s', (_, isGood, pairs) => {
  expect(areMarksGood({ meshes: [file, file], pairs })).toBe(isGood);
  expect(areMarksGood({ meshes: [null, null], pairs })).toBe(true);
});

test('a mesh with faults is repaired, and one that cannot be is refused in the core’s words', () => {
  const bytes = (text: string): Uint8Array => new TextEncoder().encode(text);
  expect(file.repairs).toBe('');
  const open = meshFile({ name: 'open.obj', bytes: bytes(OBJ.replace('f 4 2 5\n', 'f 2 4 3\n')) });
  expect(open.repairs).toMatch(/double face.*dropped.*1 hole was capped/);
  expect(open.faceCount).toBe(4);
  // The faces of the caps have no number in the file; the other faces keep theirs.
  const at = (face: number): boolean =>
    areMarksGood({ meshes: [open, null], pairs: [pair(1, { face, barycentric: [0.2, 0.3, 0.5] }, null)] });
  expect([at(0), at(1), at(2), at(3), at(4)]).toEqual([true, true, true, false, false]);
  const twin = 'v 10 0 0\nv 12 0 0\nv 10 3 0\nv 10 0 4\nf 6 8 7\nf 6 7 9\nf 7 8 9\nf 8 6 9\n';
  expect(() => meshFile({ name: 'twins.obj', bytes: bytes(OBJ + twin) })).toThrow(/^twins\.obj: .*2 separate parts/);
});

test.each(['sphere-tetrahedron', 'horse-cat', 'hands'])('the page’s module has the meshes of the demo %s as the core reads them', (id) => {
  const demo = fileAnswer({ kind: 'demo', id }) as DemoFiles;
  for (const { file, reading } of demo.meshes) {
    const read = meshReading(file, {});
    if (reading.kind === 'bad' || read.kind === 'bad') {
      throw new Error('a demo was refused');
    }
    expect(Buffer.from(reading.packed).equals(read.packed), file.name).toBe(true);
    expect([reading.repairs, reading.remarks]).toEqual([read.repairs, read.remarks]);
  }
});
