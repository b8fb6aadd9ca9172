/** Thumbnails of coarse maps. */
import { expect, test } from 'vitest';
import type { AnswerPicture } from '../../www/compute/match-messages.ts';
import type { Axes, Vector } from '../../www/method/axes.ts';
import { rotated } from '../../www/method/axes.ts';
import { scaleOf, seenOf } from '../../www/panels/answer-painting.ts';

const FRONT: Axes = { right: [1, 0, 0], up: [0, 1, 0], back: [0, 0, 1] };
/** An octahedron, and its image turned by half a turn about the vertical axis. */
const CORNERS: readonly Vector[] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
const FACES = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
const PICTURE: AnswerPicture = {
  triangles: new Uint32Array(FACES.flat()),
  places: [new Float32Array(CORNERS.flat()), new Float32Array(CORNERS.flatMap((place) => rotated(place, [0, 1, 0], Math.PI)))],
};

const turned = (angle: number): Axes => ({
  right: rotated(FRONT.right, FRONT.up, angle),
  up: FRONT.up,
  back: rotated(FRONT.back, FRONT.up, angle),
});
const area = ({ corners: [a, b, c] }: ReturnType<typeof seenOf>[number]): number =>
  a === undefined || b === undefined || c === undefined ? NaN : ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;

test('of a convex body the front is seen once, and covers what the whole does', () => {
  for (const angle of [0, 0.4, 1.9, 4]) {
    const seen = seenOf(PICTURE, 0, turned(angle));
    const back = seenOf(PICTURE, 0, turned(angle + Math.PI));
    const total = (all: typeof seen): number => all.reduce((sum, triangle) => sum + area(triangle), 0);
    expect(seen.every((triangle) => area(triangle) >= 0)).toBe(true);
    expect(total(seen)).toBeCloseTo(total(back), 5);
    expect(seen.length + back.length).toBeLessThanOrEqual(FACES.length);
  }
});

test('whatever is seen fits its frame', () => {
  const frame = { middle: [0, 0], width: 200, height: 90 } as const;
  for (const angle of [0, 0.4, 1.9, 4]) {
    const seen = seenOf(PICTURE, 1, turned(angle));
    const corners = seen.flatMap((triangle) => triangle.corners).map((corner) => corner.map((at) => Math.abs(at) * scaleOf(seen, frame)));
    const [across, along] = [Math.max(...corners.map(([x = 0]) => x)), Math.max(...corners.map(([, y = 0]) => y))];
    expect(Math.max(across / 100, along / 45)).toBeCloseTo(0.94, 5);
  }
});

test('what is nearer comes later', () => {
  const depths = seenOf(PICTURE, 0, turned(0.7)).map(({ depth }) => depth);
  expect(depths).toEqual(depths.toSorted((a, b) => a - b));
});

test('an image has the colours of the places that it is of', () => {
  // The image is the source turned by half a turn, so from behind it looks as the source does from the front.
  const colours = (side: 0 | 1, axes: Axes): number[][] => seenOf(PICTURE, side, axes).map(({ colour }) => colour.map((value) => Math.round(value)));
  const sorted = (all: number[][]): number[][] => all.toSorted((a, b) => a.join().localeCompare(b.join()));
  expect(sorted(colours(1, turned(0.3 + Math.PI)))).toEqual(sorted(colours(0, turned(0.3))));
  expect(sorted(colours(1, turned(0.3)))).not.toEqual(sorted(colours(0, turned(0.3))));
});
