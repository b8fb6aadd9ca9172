/** The base domain as a flat picture: shaded triangles, their sides, and balls at the cones. */
import type { BaseOutput } from '../compute/messages.ts';
import type { Side } from '../landmarks.ts';
import type { Axes, Vector } from './axes.ts';
import { cross, dot, minus, plus, times, unit } from './axes.ts';
import type { Fragment, PaintTree } from './painter.ts';
import { fromBehind, paintTree } from './painter.ts';
import type { BasePart } from './parts.ts';
import { conesOfFace, endsOfSides, faceCount, sidesOfFace } from './parts.ts';

/** A base domain in the shape of one mesh, ready to be drawn from any side. */
export interface Solid {
  readonly base: BaseOutput;
  /** The positions of the cones. */
  readonly cones: readonly Vector[];
  /** The curvatures of the cones, in radians. */
  readonly curvatures: readonly number[];
  /** The two cones that each side joins. */
  readonly ends: readonly (readonly [number, number])[];
  readonly tree: PaintTree | null;
  /** The middle of the picture, and the distance of the farthest cone from it. */
  readonly middle: Vector;
  readonly radius: number;
}

/** How the base domain is viewed. */
export interface Look {
  readonly axes: Axes;
  /** Size of the picture, in pixels. */
  readonly width: number;
  readonly height: number;
  /** The zoom; at 1 the whole just fits. */
  readonly zoom: number;
}

/** A place of the picture in pixels, y downwards. */
export interface Spot {
  readonly x: number;
  readonly y: number;
}

/** A fragment of a triangle as it is seen. */
export interface Facet {
  readonly face: number;
  readonly corners: readonly Spot[];
  /** The sides of the triangle that border the facet, with the corners between which they run. */
  readonly sides: readonly { readonly side: number; readonly from: Spot; readonly to: Spot }[];
  /** How light the facet is, from 0 to 1. */
  readonly light: number;
}

/** A cone as it is seen. */
export interface Ball {
  readonly cone: number;
  readonly at: Spot;
  /** The radius in pixels. */
  readonly radius: number;
  readonly sign: 'positive' | 'negative';
  /** Whether a triangle hides it. */
  readonly isHidden: boolean;
}

export interface Picture {
  /** The facets from the farthest to the nearest. */
  readonly facets: readonly Facet[];
  /** The balls from the farthest to the nearest. */
  readonly balls: readonly Ball[];
  /** The place of each cone. */
  readonly spots: readonly Spot[];
}

/** The share of the picture's size that the whole fills; the balls need the rest. */
const FILLED = 0.86;
/** The radius of a flat cone's ball, and the growth up to the largest curvature, in pixels of a picture of height 300. */
const BALL = 3;
const GROWTH = 7;
/** How near the pointer must be to a side to mean it, in pixels. */
const REACH = 5;

function vectorsOf(numbers: Float32Array): readonly Vector[] {
  return Array.from({ length: numbers.length / 3 }, (_, k): Vector => [numbers[3 * k] ?? 0, numbers[3 * k + 1] ?? 0, numbers[3 * k + 2] ?? 0]);
}

const ORIGIN: Vector = [0, 0, 0];

/** The base domain in the shape of a mesh. */
export function solidOf(base: BaseOutput, side: Side): Solid {
  const shape = base.shapes[side];
  const cones = vectorsOf(shape.cones);
  const corner = (k: number): Vector => cones[k] ?? ORIGIN;
  const triangles = Array.from({ length: faceCount(base) }, (_, face) => {
    const [a, b, c] = conesOfFace(base, face);
    return { corners: [corner(a), corner(b), corner(c)] as const, sides: sidesOfFace(base, face) };
  });
  const along = (k: 0 | 1 | 2): number => {
    const values = cones.map((cone) => cone[k]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  const middle: Vector = cones.length === 0 ? ORIGIN : [along(0), along(1), along(2)];
  const radius = Math.max(...cones.map((cone) => Math.sqrt(dot(minus(cone, middle), minus(cone, middle)))), 1e-300);
  return { base, cones, curvatures: [...shape.curvatures], ends: endsOfSides(base), tree: paintTree(triangles), middle, radius };
}

function projection({ middle, radius }: Solid, { axes, width, height, zoom }: Look): (at: Vector) => Spot {
  const scale = (FILLED * zoom * Math.min(width, height)) / 2 / radius;
  return (at) => {
    const from = minus(at, middle);
    return { x: width / 2 + scale * dot(from, axes.right), y: height / 2 - scale * dot(from, axes.up) };
  };
}

/** How light a triangle is under a soft key light from the viewer's upper left, as in the views. */
function lightOn(normal: Vector, { right, up, back }: Axes): number {
  const key = unit(plus(back, plus(times(up, 0.75), times(right, -0.55))));
  const seen = dot(normal, back) < 0 ? times(normal, -1) : normal;
  return Math.min(1, Math.max(0, 0.3 + 0.7 * dot(seen, key)) ** 1.2);
}

/** Whether a triangle lies between a point and a viewer far away. */
function hides([a, b, c]: readonly [Vector, Vector, Vector], at: Vector, towardsViewer: Vector, slack: number): boolean {
  const [p, q] = [minus(b, a), minus(c, a)];
  const h = cross(towardsViewer, q);
  const volume = dot(p, h);
  if (Math.abs(volume) < 1e-12 * dot(p, p)) {
    return false;
  }
  const from = minus(at, a);
  const u = dot(from, h) / volume;
  const g = cross(from, p);
  const v = dot(towardsViewer, g) / volume;
  return u >= 0 && v >= 0 && u + v <= 1 && dot(q, g) / volume > slack;
}

/** The radius of a cone's ball, in pixels of a picture of height 300. */
export function ballRadius(curvature: number): number {
  return BALL + GROWTH * Math.sqrt(Math.min(1, Math.abs(curvature) / (2 * Math.PI)));
}

function ballsOf(solid: Solid, look: Look, spots: readonly Spot[]): readonly Ball[] {
  const { base, cones } = solid;
  const { back } = look.axes;
  const size = Math.min(1.6, Math.max(0.7, look.height / 300));
  const faces = Array.from({ length: faceCount(base) }, (_, face) => conesOfFace(base, face));
  const corner = (k: number): Vector => cones[k] ?? ORIGIN;
  const isHidden = (cone: number): boolean =>
    faces.some((of) => !of.includes(cone) && hides([corner(of[0]), corner(of[1]), corner(of[2])], corner(cone), back, 1e-6 * solid.radius));
  const order = cones.map((at, cone) => ({ cone, depth: dot(at, back) })).sort((a, b) => a.depth - b.depth);
  return order.map(({ cone }) => {
    const curvature = solid.curvatures[cone] ?? 0;
    return {
      cone,
      at: spots[cone] ?? { x: 0, y: 0 },
      radius: size * ballRadius(curvature),
      sign: curvature < 0 ? 'negative' : 'positive',
      isHidden: isHidden(cone),
    };
  });
}

function facetOf({ face, normal, corners }: Fragment, axes: Axes, place: (at: Vector) => Spot): Facet {
  const spots = corners.map(({ at }) => place(at));
  const spot = (k: number): Spot => spots[k % spots.length] ?? { x: 0, y: 0 };
  const sides = corners.flatMap(({ side }, k) => (side === null ? [] : [{ side, from: spot(k), to: spot(k + 1) }]));
  return { face, corners: spots, sides, light: lightOn(normal, axes) };
}

/** The picture of a base domain from a given direction. */
export function pictureOf(solid: Solid, look: Look): Picture {
  const place = projection(solid, look);
  const spots = solid.cones.map(place);
  const facets = fromBehind(solid.tree, look.axes.back).map((fragment) => facetOf(fragment, look.axes, place));
  return { facets, balls: ballsOf(solid, look, spots), spots };
}

function isInside(corners: readonly Spot[], { x, y }: Spot): boolean {
  const signs = corners.map((from, k) => {
    const to = corners[(k + 1) % corners.length] ?? from;
    return Math.sign((to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x));
  });
  return corners.length > 2 && !(signs.includes(1) && signs.includes(-1));
}

function distanceTo({ from, to }: { readonly from: Spot; readonly to: Spot }, { x, y }: Spot): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = dx * dx + dy * dy;
  const share = length > 0 ? Math.min(1, Math.max(0, ((x - from.x) * dx + (y - from.y) * dy) / length)) : 0;
  return Math.hypot(x - from.x - share * dx, y - from.y - share * dy);
}

/**
 * The part under the pointer: the nearest ball that is not hidden, else a side of a visible facet, else the triangle there; `null` beside
 * all of them.
 */
export function partAt({ facets, balls }: Picture, at: Spot): BasePart | null {
  const ball = balls.findLast((each) => !each.isHidden && Math.hypot(each.at.x - at.x, each.at.y - at.y) <= each.radius + 2);
  if (ball !== undefined) {
    return { kind: 'cone', index: ball.cone };
  }
  for (const { face, corners, sides } of facets.toReversed()) {
    const side = sides.find((each) => distanceTo(each, at) <= REACH);
    if (side !== undefined) {
      return { kind: 'side', index: side.side };
    }
    if (isInside(corners, at)) {
      return { kind: 'face', index: face };
    }
  }
  return null;
}
