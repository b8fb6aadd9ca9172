/**
 * The JSON inside a link, version 1: short names and flat lists, because an address must stay short. What a reader may leave
 * out without showing something else may be added to a version; everything else (repairs, textures, other kinds of points)
 * needs a new one, and a writer takes the lowest version that can say what it has to say.
 */
import * as v from 'valibot';
import type { SurfacePoint } from '../landmarks.ts';
import { isSamePoint } from '../landmarks.ts';
import { LONGEST_ADDRESS } from './address.ts';
import { Axis, Cameras, Index, MOST_PAIRS, Options, StyleSchema, Text, Weight } from './schema.ts';

export const VERSION = 1;

/** Parts of one that a barycentric weight of a click is a whole number of, as `rounded` makes it. */
const STEPS = 10_000;

const Steps = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(STEPS));

/**
 * A point: a vertex; a face with its first two weights, each a number of steps; a face with three weights in full, where they
 * are no whole steps; 0-length for none.
 */
const WirePoint = v.union([
  Index,
  v.pipe(
    v.strictTuple([Index, Steps, Steps]),
    v.check(([, first, second]) => first + second <= STEPS),
  ),
  v.strictTuple([Index, Weight, Weight, Weight]),
  v.strictTuple([]),
]);
const WirePoints = v.pipe(v.array(WirePoint), v.maxLength(MOST_PAIRS));

/** A mesh by its address, or by its hash and name. */
const WireFile = v.union([
  v.strictTuple([v.pipe(v.string(), v.minLength(1), v.maxLength(LONGEST_ADDRESS))]),
  v.strictTuple([v.pipe(v.string(), v.regex(/^[\w-]{43}$/)), Text]),
  v.strictTuple([]),
]);

/** What a link holds beside where its meshes are. */
export const WireLink = v.object({
  /** A demo, or two files. */
  d: v.optional(v.pipe(Text, v.minLength(1))),
  f: v.optional(v.strictTuple([WireFile, WireFile])),
  /** The pairs' points on the source and on the target. */
  p: v.strictTuple([WirePoints, WirePoints]),
  /** The pairs' numbers where they are not 1, 2, 3 … */
  i: v.optional(v.pipe(v.array(v.pipe(Index, v.minValue(1))), v.maxLength(MOST_PAIRS))),
  /** Their labels, as long as there are any. */
  n: v.optional(v.pipe(v.array(Text), v.maxLength(MOST_PAIRS))),
  /** Places in the list of those that are locked. */
  x: v.optional(v.pipe(v.array(Index), v.maxLength(MOST_PAIRS))),
  /** What is known of the true map, as landmark files say it. */
  g: v.optional(Text),
  /** Which direction of each file is up. */
  u: v.strictTuple([Axis, Axis]),
  o: Options,
  c: Cameras,
  s: StyleSchema,
});

export type WireLink = v.InferOutput<typeof WireLink>;
export type WirePoint = v.InferOutput<typeof WirePoint>;
export type WireFile = v.InferOutput<typeof WireFile>;

function step(weight: number): number | null {
  const steps = Math.round(weight * STEPS);
  return steps / STEPS === weight ? steps : null;
}

/** A point in as few characters as give the very same point back. */
export function wirePoint(point: SurfacePoint | null): WirePoint {
  if (point === null || typeof point === 'number') {
    return point ?? [];
  }
  const { face, barycentric } = point;
  const [first, second] = barycentric.map(step);
  const isShort = first !== null && second !== null && first !== undefined && second !== undefined;
  const short: WirePoint = isShort ? [face, first, second] : [];
  return isShort && isSamePoint(surfacePoint(short), point) ? short : [face, ...barycentric];
}

/** The point that was meant. */
export function surfacePoint(point: WirePoint): SurfacePoint | null {
  if (typeof point === 'number') {
    return point;
  }
  if (point.length === 0) {
    return null;
  }
  if (point.length === 4) {
    const [face, ...barycentric] = point;
    return { face, barycentric };
  }
  const [face, first, second] = point;
  return { face, barycentric: [first / STEPS, second / STEPS, (STEPS - first - second) / STEPS] };
}
