/** Types of points, pairs and suggestions of landmarks, which the store, the sentences and the views share. */

import type { Reason } from './wasm/core.js';

/** 0 the source, 1 the target. */
export type Side = 0 | 1;
export const SIDES: readonly [0, 1] = [0, 1];

/** The other side. */
export function otherSide(side: Side): Side {
  return side === 0 ? 1 : 0;
}

/** A point of a surface: a vertex of the file, or a place in a face. */
export type SurfacePoint =
  | number
  | { readonly face: number; readonly barycentric: readonly [number, number, number] };

/** Two points that correspond, or a half pair: one point that waits for its partner. */
export interface Pair {
  /** The id for events, keys of lists and the selection; it is never given to another pair while the page is open. */
  readonly id: number;
  /** The number that the page shows, from 1, and by which it colours the pair; the others keep theirs when a pair is deleted. */
  readonly number: number;
  /** The points on the source and on the target; `null` where a point is missing. */
  readonly points: readonly [SurfacePoint | null, SurfacePoint | null];
  readonly label: string;
  /** A locked pair is neither moved nor deleted. */
  readonly locked: boolean;
  /**
   * The radius of a soft pair: how far the run may move its point on the target, in units of the root of that mesh's area. A pair without a
   * radius is held where it is.
   */
  readonly radius?: number;
}

/** The radius that a pair has when it is made soft, and the largest one that the core takes. */
export const USUAL_RADIUS = 0.02;
export const MAX_RADIUS = 0.25;

/** The least number of pairs that tell how one body lies to the other. */
export const PAIRS_TO_TURN = 3;

/** A pair with both its points. */
export interface WholePair extends Pair {
  readonly points: readonly [SurfacePoint, SurfacePoint];
}

export function isWhole(pair: Pair): pair is WholePair {
  return pair.points[0] !== null && pair.points[1] !== null;
}

/** Whether two points are the same one. */
export function isSamePoint(a: SurfacePoint | null, b: SurfacePoint | null): boolean {
  if (a === null || b === null || typeof a === 'number' || typeof b === 'number') {
    return a === b;
  }
  return a.face === b.face && a.barycentric.every((weight, corner) => weight === b.barycentric[corner]);
}

/** The number of steps in a barycentric coordinate from 0 to 1: finer than a screen shows, with few digits in a file or link. */
const STEPS = 10_000;

/** A point as it is kept: a click is rounded once, when it is made, so that file, link and map have the same place. */
export function rounded(point: SurfacePoint): SurfacePoint {
  if (typeof point === 'number') {
    return point;
  }
  const [a, b] = point.barycentric;
  const first = Math.min(STEPS, Math.max(0, Math.round(a * STEPS)));
  const second = Math.min(STEPS - first, Math.max(0, Math.round(b * STEPS)));
  return { face: point.face, barycentric: [first / STEPS, second / STEPS, (STEPS - first - second) / STEPS] };
}

/** A place of one mesh that is worth a landmark. */
export interface Suggestion {
  readonly point: number;
  /** Why the place is suggested: it is the end of a limb, or far from all landmarks. */
  readonly reason: Reason;
  /** Its name on the page. */
  readonly letter: string;
  /** The letter of the suggestion that looks alike, as a left and a right one do; `null` for none. */
  readonly partner: string | null;
}

/** How suggestions that look alike are taken: each alone, or both together where left and right go together. */
export type Taking = 'alone' | 'together';

/** A landmark file as the core reads it. */
export interface LandmarkFile {
  readonly source?: string;
  readonly target?: string;
  readonly pairs: readonly (readonly [SurfacePoint, SurfacePoint])[];
  /** The radius of each pair, in units of the root of the target's area; 0 for a pair that is held. */
  readonly radii?: readonly number[];
  readonly labels?: readonly string[];
  readonly ground_truth?: string;
}
