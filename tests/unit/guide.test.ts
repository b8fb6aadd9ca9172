/** The guide's drawings satisfy the theorems that they show. */
import { describe, expect, test } from 'vitest';
import {
  angle,
  area,
  circumcircle,
  distance,
  distortion,
  edgeLength,
  intersection,
  kernel,
  orientation,
  pathLength,
  point,
  polar,
  spiral,
  stacked,
} from '../../www/guide/geometry.ts';
import type { Point } from '../../www/guide/geometry.ts';
import { METHOD } from '../../www/guide/steps.ts';
import { typeset } from '../../www/guide/typeset.ts';

const TRIANGLE = [point(0, 0), point(4, 0), point(1, 3)] as const;
const UNIT_SQUARE = [point(0, 0), point(1, 0), point(1, 1), point(0, 1)];

describe('the drawings', () => {
  test('a stacked triangulation has 3n - 6 edges, 2n - 4 faces with the outer one, and covers its triangle', () => {
    for (const n of [3, 4, 7, 12]) {
      const { points, faces } = stacked(TRIANGLE, n);
      const edges = new Set(faces.flatMap((face) => face.map((a, k) => [a, face[(k + 1) % 3] ?? a].sort((p, q) => p - q).join())));
      expect([points.length, edges.size, faces.length + 1]).toEqual([n, 3 * n - 6, 2 * n - 4]);
      const areas = faces.map((face) => area(face.map((v) => points[v] ?? point(NaN, NaN))));
      expect(Math.min(...areas)).toBeGreaterThan(0);
      expect(areas.reduce((sum, size) => sum + size)).toBeCloseTo(area(TRIANGLE), 12);
    }
  });

  test('the pieces of two triangulations of one square have its area', () => {
    const fan = (centre: Point): readonly (readonly Point[])[] =>
      UNIT_SQUARE.map((p, k) => [p, UNIT_SQUARE[(k + 1) % 4] ?? p, centre]);
    const pieces = fan(point(0.3, 0.6)).flatMap((a) => fan(point(0.7, 0.2)).map((b) => intersection(a, b)));
    expect(pieces.reduce((sum, piece) => sum + area(piece), 0)).toBeCloseTo(1, 12);
    expect(intersection(UNIT_SQUARE, UNIT_SQUARE.map(({ x, y }) => point(x + 2, y)))).toEqual([]);
  });

  test('a point of the kernel sees every edge from its left, and one outside does not', () => {
    const star = [point(0, 0), point(4, 0), point(4, 3), point(2, 1.5), point(0, 3)];
    const seesAll = (p: Point): boolean => star.every((a, k) => orientation(a, star[(k + 1) % 5] ?? a, p) >= -1e-12);
    const seen = kernel(star);
    expect(area(seen)).toBeGreaterThan(0.1);
    expect(seen.every(seesAll)).toBe(true);
    expect(seesAll(point(3.5, 2))).toBe(false);
  });

  test('the circumcircle goes through the corners, and the angles of a triangle sum to pi', () => {
    const [a, b, c] = TRIANGLE;
    const { centre, radius } = circumcircle(a, b, c);
    for (const corner of TRIANGLE) {
      expect(distance(centre, corner)).toBeCloseTo(radius, 12);
    }
    expect(angle(a, b, c) + angle(b, c, a) + angle(c, a, b)).toBeCloseTo(Math.PI, 12);
  });

  test('opposite angles over an edge exceed pi exactly where the fourth corner lies in the circle of the others', () => {
    const [a, b, c] = TRIANGLE;
    const { centre, radius } = circumcircle(a, b, c);
    // A place below the middle of the edge from a to b.
    for (const share of [0.9, 1.1]) {
      const under = Math.sqrt(radius ** 2 - (centre.x - 2) ** 2) - centre.y;
      const fourth = point(2, -under * share);
      expect(angle(c, a, b) + angle(fourth, a, b) > Math.PI).toBe(share < 1);
    }
  });

  test('circles touch at inversive distance 1 and cross at right angles at 0', () => {
    expect(edgeLength([2, 3], 1)).toBeCloseTo(5, 12);
    expect(edgeLength([3, 4], 0)).toBeCloseTo(5, 12);
    expect(edgeLength([2, 3], 2)).toBeGreaterThan(5);
  });

  test('a map and its inverse are distorted alike', () => {
    const [there, back] = [distortion(2, 0.7), distortion(1 / 2, 1 / 0.7)];
    expect(back.density).toBeCloseTo(there.density, 12);
    expect(back.angle).toBeCloseTo(there.angle, 12);
    expect(there.area * back.area).toBeCloseTo(1, 12);
    expect(distortion(1, 1)).toEqual({ density: 1, angle: 1, area: 1 });
  });

  test('a path that winds is longer, and ends where a straight one does after whole turns', () => {
    const [straight, wound] = [spiral(1, 2, 0.3, 0, 200), spiral(1, 2, 0.3, 1, 200)];
    expect(pathLength(straight)).toBeCloseTo(1, 12);
    expect(pathLength(wound)).toBeGreaterThan(9);
    expect(distance(straight.at(-1) ?? point(0, 0), wound.at(-1) ?? point(0, 0))).toBeCloseTo(0, 12);
    expect(wound.at(-1)).toEqual(polar(0.3 + 2 * Math.PI, 2));
  });
});

describe('the equations', () => {
  test('are MathML without an inline style, which the page would refuse', () => {
    expect(METHOD).toHaveLength(10);
    for (const { formula } of METHOD) {
      const markup = typeset(formula.tex);
      expect(markup).toContain('<math');
      expect(markup).not.toContain('style=');
    }
  });

  test('that are no TeX are refused', () => {
    expect(() => typeset(String.raw`\nonsense{x`)).toThrow();
  });
});
