/**
 * Sorts triangles in space by a binary space partition, so that from any direction a painter can draw them over each other from the
 * farthest to the nearest (Fuchs, Kedem and Naylor 1980). A triangle that crosses the plane of another one is cut there, so that the order
 * is also right where triangles cross.
 */
import type { Vector } from './axes.ts';
import { between, cross, dot, minus, unit } from './axes.ts';

/** A corner of a fragment, with the side of the triangle that begins there. */
export interface Corner {
  readonly at: Vector;
  /** The number of the triangle's side; `null` where the border runs along a cut. */
  readonly side: number | null;
}

/** A convex part of a triangle. */
export interface Fragment {
  /** The number of the triangle. */
  readonly face: number;
  /** The unit normal; the zero vector where the triangle has no area. */
  readonly normal: Vector;
  readonly corners: readonly Corner[];
}

/** A tree of fragments, divided by the plane of one of them. */
export interface PaintTree {
  readonly normal: Vector;
  readonly inPlane: readonly Fragment[];
  readonly before: PaintTree | null;
  readonly behind: PaintTree | null;
}

/** A triangle with the numbers of its sides: side k goes from corner k to k + 1. */
export interface Triangle {
  readonly corners: readonly [Vector, Vector, Vector];
  readonly sides: readonly [number, number, number];
}

/**
 * Points nearer to a plane than this share of the whole size count as in the plane; it is a little more than the rounding error of single
 * precision.
 */
const IN_PLANE = 1e-5;
/** The most planes that are tried to find the one that cuts the fewest fragments. */
const TRIED = 24;

interface Plane {
  readonly normal: Vector;
  readonly offset: number;
  /** Points nearer than this count as in the plane. */
  readonly slack: number;
}

function planeOf({ normal, corners }: Fragment, slack: number): Plane {
  return { normal, offset: dot(normal, corners[0]?.at ?? [0, 0, 0]), slack };
}

/** 1 before the plane, -1 behind it, 0 in it. */
function sideOf({ normal, offset, slack }: Plane, at: Vector): -1 | 0 | 1 {
  const distance = dot(normal, at) - offset;
  return distance > slack ? 1 : distance < -slack ? -1 : 0;
}

type Halves = Readonly<Record<'before' | 'behind', Fragment | null>>;

/** The part on one side of a plane of a fragment that crosses it. */
function partOf(fragment: Fragment, plane: Plane, wanted: -1 | 1): Fragment {
  const { corners } = fragment;
  const found: Corner[] = [];
  corners.forEach((corner, k) => {
    const next = corners[(k + 1) % corners.length] ?? corner;
    const [here, there] = [sideOf(plane, corner.at), sideOf(plane, next.at)];
    const crosses = here * there < 0;
    const crossing = (): Vector => {
      const [a, b] = [dot(plane.normal, corner.at) - plane.offset, dot(plane.normal, next.at) - plane.offset];
      return between(corner.at, next.at, a / (a - b));
    };
    if (here === wanted) {
      found.push(corner);
      if (crosses) {
        found.push({ at: crossing(), side: null });
      }
    } else {
      if (here === 0) {
        // From a corner in the plane the border runs along the cut, or back to the wanted side.
        found.push(there === wanted ? corner : { at: corner.at, side: null });
      }
      if (crosses) {
        found.push({ at: crossing(), side: corner.side });
      }
    }
  });
  return { ...fragment, corners: found };
}

/** The parts of a fragment before and behind a plane; both are `null` where it lies in the plane. */
function halves(fragment: Fragment, plane: Plane): Halves {
  const sides = fragment.corners.map(({ at }) => sideOf(plane, at));
  const [before, behind] = [sides.includes(1), sides.includes(-1)];
  if (before && behind) {
    return { before: partOf(fragment, plane, 1), behind: partOf(fragment, plane, -1) };
  }
  return { before: before ? fragment : null, behind: behind ? fragment : null };
}

/** Among the fragments that are tried, the one whose plane cuts the fewest others; `null` where none has an area. */
function leastCutting(fragments: readonly Fragment[], slack: number): Fragment | null {
  const flat = fragments.filter(({ normal }) => dot(normal, normal) > 0);
  const step = Math.max(1, Math.floor(flat.length / TRIED));
  let best: Fragment | null = null;
  let least = Infinity;
  for (let k = 0; k < flat.length; k += step) {
    const candidate = flat[k];
    if (candidate !== undefined) {
      const plane = planeOf(candidate, slack);
      const cuts = fragments.filter(({ corners }) => {
        const sides = corners.map(({ at }) => sideOf(plane, at));
        return sides.includes(1) && sides.includes(-1);
      }).length;
      if (cuts < least) {
        [best, least] = [candidate, cuts];
      }
    }
  }
  return best;
}

function tree(fragments: readonly Fragment[], slack: number): PaintTree | null {
  if (fragments.length === 0) {
    return null;
  }
  const root = leastCutting(fragments, slack);
  if (root === null) {
    // Triangles without area hide nothing, so their order does not matter.
    return { normal: [0, 0, 0], inPlane: fragments, before: null, behind: null };
  }
  const plane = planeOf(root, slack);
  const inPlane: Fragment[] = [];
  const before: Fragment[] = [];
  const behind: Fragment[] = [];
  for (const fragment of fragments) {
    const parts = fragment === root ? { before: null, behind: null } : halves(fragment, plane);
    if (parts.before === null && parts.behind === null) {
      inPlane.push(fragment);
    }
    if (parts.before !== null) {
      before.push(parts.before);
    }
    if (parts.behind !== null) {
      behind.push(parts.behind);
    }
  }
  return { normal: plane.normal, inPlane, before: tree(before, slack), behind: tree(behind, slack) };
}

/** The tree of some triangles; `null` where there are none. */
export function paintTree(triangles: readonly Triangle[]): PaintTree | null {
  const corners = triangles.flatMap((triangle) => triangle.corners);
  const size = Math.max(0, ...[0, 1, 2].map((k) => {
    const along = corners.map((corner) => corner[k as 0 | 1 | 2]);
    return Math.max(...along) - Math.min(...along);
  }));
  const fragments = triangles.map(({ corners: [a, b, c], sides }, face): Fragment => ({
    face,
    normal: unit(cross(minus(b, a), minus(c, a))),
    corners: [a, b, c].map((at, k) => ({ at, side: sides[k] ?? null })),
  }));
  return tree(fragments, IN_PLANE * size);
}

/** The fragments from the farthest to the nearest, for a viewer far away in this direction. */
export function fromBehind(root: PaintTree | null, towardsViewer: Vector): readonly Fragment[] {
  if (root === null) {
    return [];
  }
  const [far, near] = dot(root.normal, towardsViewer) > 0 ? [root.behind, root.before] : [root.before, root.behind];
  return [...fromBehind(far, towardsViewer), ...root.inPlane, ...fromBehind(near, towardsViewer)];
}
