/** Plane geometry of the guide's drawings: exact formulas, y upwards. */

export interface Point {
  readonly x: number;
  readonly y: number;
}

export function point(x: number, y: number): Point {
  return { x, y };
}

/** The point at this angle in radians and distance from a centre. */
export function polar(angle: number, radius: number, centre: Point = { x: 0, y: 0 }): Point {
  return { x: centre.x + radius * Math.cos(angle), y: centre.y + radius * Math.sin(angle) };
}

/** The point at this share of the way from a to b. */
export function between(a: Point, b: Point, share: number): Point {
  return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(b.x - a.x, b.y - a.y);
}

/** Twice the signed area of a triangle: positive where its corners go counter-clockwise. */
export function orientation(a: Point, b: Point, c: Point): number {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/** The signed area of a polygon. */
export function area(polygon: readonly Point[]): number {
  return polygon.reduce((sum, p, k) => {
    const q = polygon[(k + 1) % polygon.length] ?? p;
    return sum + (p.x * q.y - q.x * p.y) / 2;
  }, 0);
}

/** The angle at `apex` between its directions to a and b, in radians from 0 to pi. */
export function angle(apex: Point, a: Point, b: Point): number {
  const [ux, uy, vx, vy] = [a.x - apex.x, a.y - apex.y, b.x - apex.x, b.y - apex.y];
  return Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy));
}

/** The part of a convex polygon on the left of the line from a to b (Sutherland & Hodgman 1974). */
export function leftOf(polygon: readonly Point[], a: Point, b: Point): readonly Point[] {
  return polygon.flatMap((p, k) => {
    const q = polygon[(k + 1) % polygon.length] ?? p;
    const [atP, atQ] = [orientation(a, b, p), orientation(a, b, q)];
    const kept = atP >= 0 ? [p] : [];
    return (atP > 0 && atQ < 0) || (atP < 0 && atQ > 0) ? [...kept, between(p, q, atP / (atP - atQ))] : kept;
  });
}

/** The common part of two convex polygons, both counter-clockwise; empty where they have none. */
export function intersection(polygon: readonly Point[], other: readonly Point[]): readonly Point[] {
  return other.reduce<readonly Point[]>((rest, a, k) => leftOf(rest, a, other[(k + 1) % other.length] ?? a), polygon);
}

/** The points that see the whole of a star-shaped polygon, which goes counter-clockwise; empty where there are none. */
export function kernel(polygon: readonly Point[]): readonly Point[] {
  const [xs, ys] = [polygon.map(({ x }) => x), polygon.map(({ y }) => y)];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  return intersection([point(left, low), point(right, low), point(right, high), point(left, high)], polygon);
}

export interface Circle {
  readonly centre: Point;
  readonly radius: number;
}

/** The circle through three points that are not in line. */
export function circumcircle(a: Point, b: Point, c: Point): Circle {
  const [bx, by, cx, cy] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y];
  const twice = 2 * (bx * cy - by * cx);
  const [bb, cc] = [bx * bx + by * by, cx * cx + cy * cy];
  const centre = point(a.x + (cy * bb - by * cc) / twice, a.y + (bx * cc - cx * bb) / twice);
  return { centre, radius: distance(centre, a) };
}

/** The length of an edge from the radii at its ends and their inversive distance: 1 where the circles touch, 0 where they cross at right angles. */
export function edgeLength(radii: readonly [number, number], inversiveDistance: number): number {
  const [r, s] = radii;
  return Math.sqrt(r * r + s * s + 2 * inversiveDistance * r * s);
}

/** How a linear map with these singular values distorts. */
export interface Distortion {
  /** (s1² + s2² + s1⁻² + s2⁻²) / 4; 1 for an isometry. */
  readonly density: number;
  /** (s1/s2 + s2/s1) / 2; 1 where angles stay. */
  readonly angle: number;
  /** s1 s2; 1 where areas stay. */
  readonly area: number;
}

export function distortion(s1: number, s2: number): Distortion {
  return { density: (s1 ** 2 + s2 ** 2 + s1 ** -2 + s2 ** -2) / 4, angle: (s1 / s2 + s2 / s1) / 2, area: s1 * s2 };
}

/** A triangulation of the inside of a triangle: its points, and the three corners of each face. */
export interface Triangulation {
  readonly points: readonly Point[];
  readonly faces: readonly (readonly [number, number, number])[];
}

/** A triangle into which points are put one by one, each into the largest face; `count` corners in the end, at least 3. */
export function stacked(corners: readonly [Point, Point, Point], count: number): Triangulation {
  const points: Point[] = [...corners];
  const faces: (readonly [number, number, number])[] = [[0, 1, 2]];
  const at = (index: number): Point => points[index] ?? corners[0];
  while (points.length < count) {
    const sizes = faces.map((face) => area(face.map(at)));
    const largest = sizes.indexOf(Math.max(...sizes));
    const [a, b, c] = faces[largest] ?? [0, 1, 2];
    const [p, q, r] = [at(a), at(b), at(c)];
    const next = points.push(point((p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3)) - 1;
    faces.splice(largest, 1, [a, b, next], [b, c, next], [c, a, next]);
  }
  return { points, faces };
}

/** A path from the inner to the outer rim of a ring that winds this many times around it, at even steps. */
export function spiral(inner: number, outer: number, start: number, turns: number, steps: number): readonly Point[] {
  return Array.from({ length: steps + 1 }, (_, k) => polar(start + (2 * Math.PI * turns * k) / steps, inner + ((outer - inner) * k) / steps));
}

/** The length of a path. */
export function pathLength(path: readonly Point[]): number {
  return path.slice(1).reduce((sum, q, k) => sum + distance(path[k] ?? q, q), 0);
}
