/**
 * The JSON inside a link, version 1 or 2: its names are short and its lists flat, because an address must stay short. A version may get new
 * fields that a reader can ignore without showing something else; everything else (repairs, textures, other kinds of points) needs a new
 * version, and a writer takes the lowest version that can hold its content. Version 2 can name the meshes of demos.
 */
import * as v from 'valibot';
import type { SurfacePoint } from '../landmarks.ts';
import { isSamePoint } from '../landmarks.ts';
import { INITIAL } from '../store/state.ts';
import { LONGEST_ADDRESS } from './address.ts';
import { Axis, Cameras, Index, MOST_PAIRS, Options, Radius, StyleSchema, Text, Weight } from './schema.ts';

/** The latest version, which has the mesh of a demo among its files. */
export const LATEST = 2;

/** The number of steps from 0 to 1 of a click's barycentric weights, as `rounded` makes them. */
const STEPS = 10_000;
/** The number of values that such a weight can have. */
const VALUES = STEPS + 1;

/** A click as one number, `(face * VALUES + first) * VALUES + second`, from its face and its first and second weight in steps. */
const Click = v.pipe(
  v.number(),
  v.safeInteger(),
  v.minValue(0),
  v.check((click) => (click % VALUES) + (Math.floor(click / VALUES) % VALUES) <= STEPS),
);
/** The highest number of a face that a click can be in. */
const LAST_FACE = Math.floor(Number.MAX_SAFE_INTEGER / VALUES ** 2) - 1;

/**
 * A point: a click; a vertex as a list of one number; a face with three weights, where these are not whole steps; or an empty list for
 * none.
 */
const WirePoint = v.union([
  Click,
  v.strictTuple([Index]),
  v.strictTuple([Index, Weight, Weight, Weight]),
  v.strictTuple([]),
]);
const WirePoints = v.pipe(v.array(WirePoint), v.maxLength(MOST_PAIRS));

/** A mesh: its address, its hash and name, or the id of its demo and its side there; empty for none. */
const WireFile = v.union([
  v.strictTuple([v.pipe(v.string(), v.minLength(1), v.maxLength(LONGEST_ADDRESS))]),
  v.strictTuple([v.pipe(v.string(), v.regex(/^[\w-]{43}$/)), Text]),
  v.strictTuple([v.pipe(Text, v.minLength(1)), v.picklist([0, 1])]),
  v.strictTuple([]),
]);

/** The content of a link beside the addresses of its meshes. */
export const WireLink = v.object({
  /** The id of a demo, or two files. */
  d: v.optional(v.pipe(Text, v.minLength(1))),
  f: v.optional(v.strictTuple([WireFile, WireFile])),
  /** The pairs' points on the source and on the target. */
  p: v.strictTuple([WirePoints, WirePoints]),
  /** The pairs' numbers where they are not 1, 2, 3 … */
  i: v.optional(v.pipe(v.array(v.pipe(Index, v.minValue(1))), v.maxLength(MOST_PAIRS))),
  /** The labels of the pairs; left out where there are none. */
  n: v.optional(v.pipe(v.array(Text), v.maxLength(MOST_PAIRS))),
  /** The indices of the locked pairs. */
  x: v.optional(v.pipe(v.array(Index), v.maxLength(MOST_PAIRS))),
  /** The indices of the soft pairs, each with its radius. */
  r: v.optional(v.pipe(v.array(v.strictTuple([Index, Radius])), v.maxLength(MOST_PAIRS))),
  /** What is known about the true map, in the words of landmark files. */
  g: v.optional(Text),
  /** The direction of each file that points up. */
  u: v.strictTuple([Axis, Axis]),
  o: Options,
  /** How the work was viewed; a field whose value this page does not know gets its initial value. */
  c: v.fallback(Cameras, [null, null]),
  s: v.fallback(StyleSchema, INITIAL.ui.style),
});

export type WireLink = v.InferOutput<typeof WireLink>;
/** A link as it is written, in which usual choices may be left out. */
export type WrittenLink = v.InferInput<typeof WireLink>;
export type WirePoint = v.InferOutput<typeof WirePoint>;
export type WireFile = v.InferOutput<typeof WireFile>;

/** A point in the fewest characters that give exactly the same point back. */
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

/** The point that a wire point stands for; `null` for none. */
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
