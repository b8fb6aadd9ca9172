/**
 * The flat metrics in the plane: each mesh is complete, cut where the core cuts it, with its patches, lines and cones at the right places.
 */
import { beforeAll, describe, expect, test } from 'vitest';
import type { BaseOutput } from '../../www/compute/messages.ts';
import { viewBuffers } from '../../www/compute/view-buffers.ts';
import { fitted, planeObj, planeSvg } from '../../www/method/plane-drawing.ts';
import { stepped } from '../../www/method/parts.ts';
import type { Spot } from '../../www/method/sheet.ts';
import { Sheet } from '../../www/method/sheet.ts';
import { wordsOf } from '../../www/unions.ts';
import type { CollapsedMesh, FlatPlanes, MapOutput } from '../../www/wasm/core.js';
import { buildDemo, flatPlanes, recordCarriedSimplification, runMap } from '../../www/wasm/core.js';
import { startCoreModule } from './modules.ts';

const nothing = (): void => undefined;
const LISTENER = { relaxes: nothing, progress: nothing, preview: nothing, found: nothing, wantsResult: (): boolean => false };

let output: MapOutput;
let planes: FlatPlanes;
let base: BaseOutput;
let landmarks: string;
let files: readonly [Uint8Array, Uint8Array];

function fail(): never {
  throw new Error('nothing there');
}

function sheetFrom(side: 0 | 1, patch: number): Sheet {
  const mesh = {
    triangles: planes.triangles(side),
    positions: planes.positions(side),
    checkedFaces: planes.checkedFaces(side),
    landmarks: planes.landmarkVertices(side),
    radii: planes.radii(side),
  };
  const grown = planes.grow(side, mesh.checkedFaces.indexOf(base.shapes[side].patchMiddles[patch] ?? fail()));
  const growth = {
    points: grown.points(),
    vertices: grown.vertices(),
    corners: grown.corners(),
    order: grown.order(),
    rings: grown.rings(),
    cut: grown.cut(),
    turnedOver: grown.turnedOver(),
  };
  return new Sheet(mesh, growth, base, side, patch);
}

function area([a, b, c]: readonly [Spot, Spot, Spot]): number {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

const sum = (numbers: readonly number[]): number => numbers.reduce((total, number) => total + number, 0);

beforeAll(() => {
  startCoreModule();
  const demo = buildDemo('sphere-tetrahedron') ?? fail();
  landmarks = new TextDecoder().decode(demo.landmarks());
  files = [demo.source(), demo.target()];
  output = runMap(files[0], files[1], landmarks, '{}', LISTENER);
  base = viewBuffers(output).base ?? fail();
  planes = flatPlanes(files[0], files[1], landmarks, output.cones(), LISTENER);
  // A map is made first, possibly on a busy machine.
}, 120_000);

describe('a mesh in the plane', () => {
  test('has area 1, and its patches are all of it', () => {
    for (const side of [0, 1] as const) {
      const sheet = sheetFrom(side, 3);
      const faces = [...sheet.growth.order];
      expect(new Set(faces).size).toBe(sheet.mesh.triangles.length / 3);
      expect(sum(faces.map((face) => area(sheet.corners(face))))).toBeCloseTo(1, 4);
      const patches = Array.from({ length: base.triangles.length / 3 }, (_, patch) => sum(sheet.patch(patch).map(({ corners }) => area(corners))));
      expect(Math.min(...patches)).toBeGreaterThan(0);
      expect(sum(patches)).toBeCloseTo(1, 3);
    }
  });

  test('begins in the middle of the patch that is chosen, which is found at its places', () => {
    for (const patch of [0, 5]) {
      const sheet = sheetFrom(0, patch);
      const count = sheet.growth.order.length;
      const [a, b, c] = sheet.corners(sheet.growth.order[0] ?? fail());
      const middle = { x: (a.x + b.x + c.x) / 3, y: (a.y + b.y + c.y) / 3 };
      expect(sheet.partAt(middle, 0, 1)).toEqual({ kind: 'face', index: patch });
      expect(sheet.partAt({ x: sheet.box[0] - 1, y: 0 }, 0, count)).toBeNull();
      expect(sheet.growth.rings[1]).toBe(1);
      // The first side of the patch points to the right.
      const line = sheet.borders.filter(({ side }) => side === base.sides[3 * patch]);
      expect(line.length).toBeGreaterThan(0);
      const from = line[0] ?? fail();
      expect(sheet.partAt(from.from, 1e-6, count)?.kind).toMatch(/cone|side/);
    }
  });

  test('is cut twice along edges of the same length, from cone to cone', () => {
    const sheet = sheetFrom(1, 0);
    const lengths = sheet.cuts.map(({ from, to }) => Math.hypot(to.x - from.x, to.y - from.y));
    expect(lengths.length).toBeGreaterThan(0);
    expect(lengths.length % 2).toBe(0);
    const sorted = [...lengths].sort((x, y) => x - y);
    for (let k = 0; k < sorted.length; k += 2) {
      expect(sorted[k]).toBeCloseTo(sorted[k + 1] ?? -1, 5);
    }
    const ends = sheet.cuts.flatMap(({ from, to }) => [from, to]);
    for (const { at } of sheet.cones) {
      expect(Math.min(...ends.map((end) => Math.hypot(end.x - at.x, end.y - at.y)))).toBeLessThan(1e-6);
    }
    expect(new Set(sheet.cones.map(({ cone }) => cone)).size).toBe(sheet.mesh.landmarks.length);
    // A cut appears only once both its triangles are placed.
    expect(sheet.cuts.every(({ when }) => when > 1)).toBe(true);
  });

  test('has circles of the packing that hardly meet', () => {
    const sheet = sheetFrom(0, 0);
    const { mesh, growth } = sheet;
    for (const face of growth.order) {
      const corners = sheet.corners(face);
      corners.forEach((corner, k) => {
        const next = corners[(k + 1) % 3] ?? fail();
        const radius = (j: number): number => mesh.radii[mesh.triangles[3 * face + (j % 3)] ?? 0] ?? 0;
        expect(radius(k)).toBeGreaterThan(0);
        expect(Math.hypot(next.x - corner.x, next.y - corner.y)).toBeGreaterThan(0.99 * (radius(k) + radius(k + 1)));
      });
    }
  });

  test('is saved as a drawing and as a mesh with texture coordinates', () => {
    const sheet = sheetFrom(0, 0);
    const count = sheet.growth.order.length;
    const drawn = { curvatures: output.cones(), names: ['<1>'], shown: count } as const;
    const svg = planeSvg(sheet, { ...drawn, circles: 'shown' });
    expect(svg).toContain('&#60;1&#62;');
    expect(svg).not.toMatch(/NaN|undefined/);
    expect(svg.match(/<circle/g)?.length).toBeGreaterThan(sheet.growth.vertices.length / 2);
    expect(planeSvg(sheet, { ...drawn, circles: 'hidden' }).match(/<circle/g)?.length).toBe(sheet.cones.length);
    const obj = planeObj(sheet);
    expect(obj.match(/^f /gm)?.length).toBe(count);
    expect(obj.match(/^vt /gm)?.length).toBe(sheet.growth.vertices.length);
    const { x, y, scale } = fitted(sheet.box, { width: 900, height: 700 });
    expect(Math.max((sheet.box[2] - x) * scale, (sheet.box[3] - y) * scale)).toBeLessThanOrEqual(450);
  });
});

test('one goes from part to part and round', () => {
  expect(stepped(null, 'face', 1, 4)).toEqual({ kind: 'face', index: 0 });
  expect(stepped({ kind: 'face', index: 3 }, 'face', 1, 4)).toEqual({ kind: 'face', index: 0 });
  expect(stepped({ kind: 'side', index: 3 }, 'face', -1, 4)).toEqual({ kind: 'face', index: 3 });
});

test('a simplification is carried to the other mesh, and every choice ends at the landmarks', () => {
  const map = viewBuffers(output);
  expect(map.triangles.length).toBeGreaterThan(0);
  const bytes = output.mapFile() ?? fail();
  for (const from of wordsOf<CollapsedMesh>({ source: true, target: true, both: true })) {
    const found = recordCarriedSimplification(bytes, files[0], files[1], landmarks, from, LISTENER);
    const counts = found.counts(0);
    expect([...found.counts(1)]).toEqual([...counts]);
    expect(counts.at(-1)).toBe(2 * output.cones().length - 4);
    expect(found.positions(0).length).toBe(found.positions(1).length);
    // The landmarks that remain are at their own positions on both meshes.
    const last = new Set(found.triangles(0).slice(-3 * (counts.at(-1) ?? 0)));
    for (const side of [0, 1] as const) {
      const cones = base.shapes[side].cones;
      const near = (v: number): number => {
        const at = found.positions(side).subarray(3 * v, 3 * v + 3);
        return Math.min(...Array.from({ length: output.cones().length }, (_, k) => Math.hypot(...[0, 1, 2].map((j) => (cones[3 * k + j] ?? 0) - (at[j] ?? 0)))));
      };
      expect(Math.max(...[...last].map(near))).toBeLessThan(1e-5);
    }
  }
  expect(() => recordCarriedSimplification(bytes, files[0], files[1], landmarks, 'nothing' as CollapsedMesh, LISTENER)).toThrow(/simplify/);
});
