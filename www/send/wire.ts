/**
 * The JSON inside a link, version 1: short names and flat lists, because an address must stay short. What a reader may leave
 * out without showing something else may be added to a version; everything else (repairs, textures, other kinds of points)
 * needs a new one, and a writer takes the lowest version that can say what it has to say.
 */
import * as v from 'valibot';
import type { SurfacePoint } from '../landmarks.ts';
import { isSamePoint } from '../landmarks.ts';
import { INITIAL } from '../store/state.ts';
import { LONGEST_ADDRESS } from './address.ts';
import { Axis, Cameras, Index, MOST_PAIRS, Options, Radius, StyleSchema, Text, Weight } from './schema.ts';

export const VERSION = 1;

/** Parts of one that a barycentric weight of a click is a whole number of, as `rounded` makes it. */
const STEPS = 10_000;
/** How many values such a weight has. */
const VALUES = STEPS + 1;

/** A click: face, first and second weight in steps as one number, `(face * VALUES + first) * VALUES + second`. */
const Click = v.pipe(
  v.number(),
  v.safeInteger(),
  v.minValue(0),
  v.check((click) => (click % VALUES) + (Math.floor(click / VALUES) % VALUES) <= STEPS),
);
/** The highest face that a click can be in. */
const LAST_FACE = Math.floor(Number.MAX_SAFE_INTEGER / VALUES ** 2) - 1;

/** A point: a click; a vertex in a list of one; a face with three weights in full, where they are no whole steps; or none. */
const WirePoint = v.union([
  Click,
  v.strictTuple([Index]),
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
  /** Places in the list of those that are soft, each with its radius. */
  r: v.optional(v.pipe(v.array(v.strictTuple([Index, Radius])), v.maxLength(MOST_PAIRS))),
  /** What is known of the true map, as landmark files say it. */
  g: v.optional(Text),
  /** Which direction of each file is up. */
  u: v.strictTuple([Axis, Axis]),
  o: Options,
  /** How it was looked at: what this page does not know of it is as at the start. */
  c: v.fallback(Cameras, [null, null]),
  s: v.fallback(StyleSchema, INITIAL.ui.style),
});

export type WireLink = v.InferOutput<typeof WireLink>;
/** What usual choices may be left out of. */
export type WrittenLink = v.InferInput<typeof WireLink>;
export type WirePoint = v.InferOutput<typeof WirePoint>;
export type WireFile = v.InferOutput<typeof WireFile>;

/** A point in as few characters as give the very same point back. */
export function wirePoint(point: SurfacePoint | null): WirePoint {
  if (point === null || typeof point === 'number') {
    return point === null ? [] : [point];
  }
  const { face, barycentric } = point;
  const [first, second] = [Math.round(barycentric[0] * STEPS), Math.round(barycentric[1] * STEPS)];
  const click = (face * VALUES + first) * VALUES + second;
  const isClick = face <= LAST_FACE && Math.min(first, second) >= 0 && first + second <= STEPS;
  return isClick && isSamePoint(surfacePoint(click), point) ? click : [face, ...barycentric];
}

/** The point that was meant. */
export function surfacePoint(point: WirePoint): SurfacePoint | null {
  if (typeof point === 'number') {
    const second = point % VALUES;
    const first = Math.floor(point / VALUES) % VALUES;
    const face = Math.floor(point / VALUES ** 2);
    return { face, barycentric: [first / STEPS, second / STEPS, (STEPS - first - second) / STEPS] };
  }
  switch (point.length) {
    case 0:
      return null;
    case 1:
      return point[0];
    case 4: {
      const [face, ...barycentric] = point;
      return { face, barycentric };
    }
  }
}
