/** The orientation of a picture, and how dragging turns it. */
import type { Axis } from '../store/state.ts';

export type Vector = readonly [number, number, number];

/** Unit vectors in the mesh's coordinates. */
export interface Axes {
  /** The direction to the right on the screen. */
  readonly right: Vector;
  /** The direction upwards on the screen. */
  readonly up: Vector;
  /** The direction from the screen to the viewer. */
  readonly back: Vector;
}

/** The angle by which a drag over the picture's height turns it, in radians; the same as in the views. */
const TURN = 4;

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/** a + share (b - a). */
export function between(a: Vector, b: Vector, share: number): Vector {
  return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])];
}

export function times(a: Vector, factor: number): Vector {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

export function plus(a: Vector, b: Vector): Vector {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

/** The same direction with length 1; the zero vector is returned unchanged. */
export function unit(a: Vector): Vector {
  const length = Math.sqrt(dot(a, a));
  return length > 0 ? times(a, 1 / length) : a;
}

/** A vector turned about a unit axis by an angle in radians, counter-clockwise seen from its tip (Rodrigues). */
export function rotated(a: Vector, axis: Vector, angle: number): Vector {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return plus(plus(times(a, c), times(cross(axis, a), s)), times(axis, dot(axis, a) * (1 - c)));
}

/** An axis of a mesh by its name: `x`, `-x`, `y`, `-y`, `z` or `-z`. */
export function upVector(axis: Axis): Vector {
  const sign = axis.startsWith('-') ? -1 : 1;
  const at = 'xyz'.indexOf(axis.slice(-1));
  return [at === 0 ? sign : 0, at === 1 ? sign : 0, at === 2 ? sign : 0];
}

/** The axes as the core returns them: right, up and back, three numbers each. */
export function axesOf(numbers: Float32Array): Axes {
  const vector = (k: number): Vector => [numbers[k] ?? 0, numbers[k + 1] ?? 0, numbers[k + 2] ?? 0];
  return { right: vector(0), up: vector(3), back: vector(6) };
}

/** The axes made orthonormal again, since rounding errors would grow from turn to turn. */
function squared({ up, back }: Axes): Axes {
  const [level, towards] = [unit(cross(up, back)), unit(back)];
  return { right: level, up: cross(towards, level), back: towards };
}

/**
 * The axes after a drag in units of the picture's height, y up: about the mesh's up axis and about the screen's level one. The picture
 * stays upright: it does not tilt beyond looking straight down or up.
 */
export function dragged(axes: Axes, upwards: Vector, dx: number, dy: number): Axes {
  const about = (axis: Vector, angle: number) => ({ right, up, back }: Axes): Axes => ({
    right: rotated(right, axis, angle),
    up: rotated(up, axis, angle),
    back: rotated(back, axis, angle),
  });
  const level = squared(about(upwards, -TURN * dx)(axes));
  const tilted = squared(about(level.right, TURN * dy)(level));
  return dot(tilted.up, upwards) < 0 ? level : tilted;
}
