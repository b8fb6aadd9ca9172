/** The base domain as a picture: drawn in the right order from all directions, turned with the views, and asked about its parts. */
import { describe, expect, test } from 'vitest';
import type { BaseOutput, BaseShape } from '../../www/compute/messages.ts';
import type { Axes, Vector } from '../../www/method/axes.ts';
import { axesOf, cross, dot, dragged, minus, plus, rotated, times, unit, upVector } from '../../www/method/axes.ts';
import { pictureSvg } from '../../www/method/drawing.ts';
import type { Fragment, Triangle } from '../../www/method/painter.ts';
import { fromBehind, paintTree } from '../../www/method/painter.ts';
import { endsOfSides, litBy } from '../../www/method/parts.ts';
import type { Look } from '../../www/method/picture.ts';
import { partAt, pictureOf, solidOf } from '../../www/method/picture.ts';
import { coneName, degrees, reading, summary } from '../../www/method/words.ts';
import { Random } from './random.ts';

const random = new Random(7);

function vector(): Vector {
  return [random.unit() * 2 - 1, random.unit() * 2 - 1, random.unit() * 2 - 1];
}

/** Random triangles in a box, many of which cross. */
function crossing(count: number): readonly Triangle[] {
  return Array.from({ length: count }, (_, k) => ({ corners: [vector(), vector(), vector()] as const, sides: [3 * k, 3 * k + 1, 3 * k + 2] as const }));
}

function axes(): Axes {
  const back = unit(vector());
  const right = unit(cross(vector(), back));
  return { right, up: cross(back, right), back };
}

function area({ corners }: Fragment): number {
  const first = corners[0]?.at ?? fail();
  let sum: Vector = [0, 0, 0];
  corners.forEach(({ at }, k) => {
    sum = plus(sum, cross(minus(at, first), minus((corners[k + 1] ?? corners[0])?.at ?? fail(), first)));
  });
  return Math.sqrt(dot(sum, sum)) / 2;
}

function fail(): never {
  throw new Error('nothing there');
}

/** The distance along a ray at which it meets a triangle; `null` where it misses the triangle. */
function meets([a, b, c]: readonly [Vector, Vector, Vector], from: Vector, along: Vector): number | null {
  const normal = cross(minus(b, a), minus(c, a));
  const way = dot(minus(a, from), normal) / dot(along, normal);
  const at = plus(from, times(along, way));
  const inside = [[a, b], [b, c], [c, a]].every(([p = a, q = a]) => dot(cross(minus(q, p), minus(at, p)), normal) >= 0);
  return inside ? way : null;
}

function holds({ corners, normal }: Fragment, from: Vector, along: Vector): boolean {
  const signs = corners.map(({ at }, k) => {
    const next = (corners[k + 1] ?? corners[0])?.at ?? at;
    return Math.sign(dot(cross(minus(next, at), along), minus(from, at)));
  });
  return dot(normal, normal) > 0 && !(signs.includes(1) && signs.includes(-1));
}

describe('the painter', () => {
  const triangles = crossing(40);
  const tree = paintTree(triangles);

  test('shows in front what is in front, also where triangles cross', () => {
    let met = 0;
    for (let k = 0; k < 60; k += 1) {
      const { back, right, up } = axes();
      const order = fromBehind(tree, back);
      for (let j = 0; j < 20; j += 1) {
        const from = plus(times(right, random.unit() * 2 - 1), times(up, random.unit() * 2 - 1));
        const hits = triangles.map(({ corners }, face) => ({ face, way: meets(corners, from, back) })).filter(({ way }) => way !== null);
        const nearest = hits.sort((a, b) => (b.way ?? 0) - (a.way ?? 0));
        const [first, second] = nearest;
        // Two triangles that are met at nearly the same place may come in either order.
        if (first === undefined || Math.abs((first.way ?? 0) - (second?.way ?? Infinity)) < 1e-3) {
          continue;
        }
        met += 1;
        expect(order.findLast((fragment) => holds(fragment, from, back))?.face).toBe(first.face);
      }
    }
    expect(met).toBeGreaterThan(500);
  });

  test('cuts without loss: areas and sides of the fragments sum to those of the triangles', () => {
    const fragments = fromBehind(tree, [0, 0, 1]);
    expect(fragments.length).toBeGreaterThan(triangles.length);
    triangles.forEach(({ corners: [a, b, c] }, face) => {
      const own = fragments.filter((fragment) => fragment.face === face);
      const normal = cross(minus(b, a), minus(c, a));
      expect(own.reduce((sum, fragment) => sum + area(fragment), 0)).toBeCloseTo(Math.sqrt(dot(normal, normal)) / 2, 4);
      [[a, b], [b, c], [c, a]].forEach(([p = a, q = a], k) => {
        const parts = own.flatMap(({ corners }) =>
          corners.flatMap(({ at, side }, j) => {
            const way = minus((corners[j + 1] ?? corners[0])?.at ?? at, at);
            return side === 3 * face + k ? [Math.sqrt(dot(way, way))] : [];
          }),
        );
        const whole = minus(q, p);
        expect(parts.reduce((sum, length) => sum + length, 0)).toBeCloseTo(Math.sqrt(dot(whole, whole)), 3);
      });
    });
  });

  test('takes what has no area, and nothing at all', () => {
    const line: Triangle = { corners: [[0, 0, 0], [1, 0, 0], [2, 0, 0]], sides: [0, 1, 2] };
    expect(fromBehind(paintTree([line]), [0, 0, 1])).toHaveLength(1);
    expect(fromBehind(paintTree([]), [0, 0, 1])).toEqual([]);
  });
});

describe('turning', () => {
  test('keeps the axes at right angles, of length 1 and upright', () => {
    let turned: Axes = { right: [1, 0, 0], up: [0, 0, 1], back: [0, -1, 0] };
    const upwards = upVector('z');
    for (let k = 0; k < 200; k += 1) {
      turned = dragged(turned, upwards, random.unit() - 0.5, random.unit() - 0.5);
      const { right, up, back } = turned;
      expect(Math.max(...[dot(right, up), dot(up, back), dot(back, right)].map(Math.abs))).toBeLessThan(1e-9);
      expect(minus(cross(right, up), back).every((x) => Math.abs(x) < 1e-9)).toBe(true);
      expect(Math.abs(dot(right, upwards))).toBeLessThan(1e-9);
      expect(dot(up, upwards)).toBeGreaterThanOrEqual(-1e-12);
    }
  });

  test('follows the pointer: what is in front goes where it is dragged', () => {
    const from: Axes = { right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1] };
    const front: Vector = [0, 0, 1];
    expect(dot(dragged(from, [0, 1, 0], 0.1, 0).right, front)).toBeGreaterThan(0);
    expect(dot(dragged(from, [0, 1, 0], 0, 0.1).up, front)).toBeGreaterThan(0);
  });

  test('goes counter-clockwise seen from the tip of the axis', () => {
    expect(minus(rotated([1, 0, 0], [0, 0, 1], Math.PI / 2), [0, 1, 0]).every((x) => Math.abs(x) < 1e-12)).toBe(true);
    expect(upVector('-y')).toEqual([0, -1, 0]);
    expect(axesOf(new Float32Array([1, 0, 0, 0, 1, 0, 0, 0, 1]))).toEqual({ right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1] });
  });
});

/** The regular tetrahedron: each corner has an angle defect of pi. */
const SHAPE: BaseShape = {
  cones: new Float32Array([1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1]),
  curvatures: new Float64Array([Math.PI, Math.PI, Math.PI, Math.PI]),
  patchPoints: new Float32Array(),
  patchTriangles: new Uint32Array(),
  patchStarts: new Uint32Array(5),
  patchFaces: new Uint32Array(),
  patchBorders: new Uint32Array(),
  patchMiddles: new Uint32Array(4),
};
const TETRAHEDRON: BaseOutput = {
  triangles: new Uint32Array([0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]),
  sides: new Uint32Array([0, 1, 2, 2, 3, 4, 4, 5, 0, 5, 3, 1]),
  shapes: [SHAPE, SHAPE],
};
const NAMES = ['1 (nose)', '2', '3'];

describe('the picture', () => {
  const solid = solidOf(TETRAHEDRON, 1);
  const towards = (at: Vector): Look => {
    const back = unit(at);
    const right = unit(cross([0.3, 0.5, 0.9], back));
    return { axes: { right, up: cross(back, right), back }, width: 300, height: 300, zoom: 1 };
  };

  test('hides the corner behind the triangle that faces the viewer', () => {
    // Seen from opposite corner 0, the triangle 1 3 2 covers everything.
    const picture = pictureOf(solid, towards([-1, -1, -1]));
    expect(picture.balls.map(({ cone, isHidden }) => [cone, isHidden]).sort()).toEqual([[0, true], [1, false], [2, false], [3, false]]);
    expect(picture.facets.at(-1)?.face).toBe(3);
    expect(partAt(picture, { x: 150, y: 150 })).toEqual({ kind: 'face', index: 3 });
    expect(partAt(picture, { x: 1, y: 1 })).toBeNull();
    const [, from, to] = picture.spots;
    expect(from !== undefined && to !== undefined && partAt(picture, { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 })).toEqual({ kind: 'side', index: 1 });
    expect(from !== undefined && partAt(picture, from)).toEqual({ kind: 'cone', index: 1 });
  });

  test('lights up a patch with its border, a path, and the paths of a corner', () => {
    expect(endsOfSides(TETRAHEDRON)).toEqual([[0, 1], [1, 2], [2, 0], [2, 3], [3, 0], [3, 1]]);
    expect(litBy(TETRAHEDRON, { kind: 'face', index: 3 })).toEqual({ patch: 3, lines: [5, 3, 1] });
    expect(litBy(TETRAHEDRON, { kind: 'side', index: 4 })).toEqual({ patch: null, lines: [4] });
    expect(litBy(TETRAHEDRON, { kind: 'cone', index: 0 })).toEqual({ patch: null, lines: [0, 2, 4] });
    expect(litBy(TETRAHEDRON, null)).toEqual({ patch: null, lines: [] });
  });

  test('is told in words', () => {
    expect(summary(solid)).toContain('4 corners, 6 sides, 4 triangles. 4 corners bulge, 0 are saddle-like; their curvatures sum to +720.0°');
    expect(reading(solid, { kind: 'cone', index: 0 }, NAMES)).toBe('Corner 1 (nose): curvature +180.0°, bulging. Its paths are lit up.');
    expect(reading(solid, { kind: 'side', index: 4 }, NAMES)).toContain('from own 1 to 1 (nose)');
    expect(reading(solid, { kind: 'face', index: 0 }, NAMES)).toContain('Triangle of 1 (nose), 2, 3');
    expect([-0.5, 0, 0.00001].map(degrees)).toEqual(['−28.6°', '0.0°', '0.0°']);
    expect(coneName(NAMES, 4)).toBe('own 2');
  });

  test('is a drawing of its own, whatever landmarks are called', () => {
    const svg = pictureSvg(pictureOf(solid, towards([-1, -1, -1])), { width: 300, height: 300 }, ['a', '<b&', 'c', 'd']);
    expect(svg).toContain('&#60;b&#38;');
    expect(svg.match(/<circle/g)).toHaveLength(3);
    expect(svg).not.toMatch(/NaN|undefined/);
  });
});
