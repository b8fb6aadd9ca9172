/**
 * Paints a coarse map as a thumbnail: each place of the source is coloured by its position, and its image on the target has the same
 * colour.
 */
import type { AnswerPicture } from '../compute/match-messages.ts';
import type { Side } from '../landmarks.ts';
import type { Axes, Vector } from '../method/axes.ts';
import { cross, dot, minus, unit } from '../method/axes.ts';

/** A triangle as it is seen by the viewer. */
export interface Seen {
  /** The corners, to the right and upwards from the middle, from -1 to 1. */
  readonly corners: readonly (readonly [number, number])[];
  /** How far the triangle is towards the viewer. */
  readonly depth: number;
  /** The colour: red, green and blue, 0 to 255. */
  readonly colour: Vector;
}

/** The share of its colour that a face keeps when it is seen edge-on; a face that is seen from the front keeps all of it. */
const LEAST_LIGHT = 0.55;
/** The least value of a colour's channel; the largest is 255 less this. */
const DARKEST = 30;

function at(places: Float32Array, vertex: number): Vector {
  return [places[3 * vertex] ?? 0, places[3 * vertex + 1] ?? 0, places[3 * vertex + 2] ?? 0];
}

/** A colour for each vertex, by its position in the bounding box of all vertices. */
function coloursOf(places: Float32Array): Vector[] {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  places.forEach((value, index) => {
    low[index % 3] = Math.min(low[index % 3] ?? value, value);
    high[index % 3] = Math.max(high[index % 3] ?? value, value);
  });
  const channel = (place: Vector, k: 0 | 1 | 2): number => {
    const [from, to] = [low[k] ?? 0, high[k] ?? 0];
    const share = to > from ? (place[k] - from) / (to - from) : 0.5;
    return DARKEST + (255 - 2 * DARKEST) * share;
  };
  return Array.from({ length: places.length / 3 }, (_, vertex) => {
    const place = at(places, vertex);
    return [channel(place, 0), channel(place, 1), channel(place, 2)];
  });
}

/** The triangles of a side that face the viewer, the farthest first. */
export function seenOf({ triangles, places }: AnswerPicture, side: Side, { right, up, back }: Axes): Seen[] {
  const colours = coloursOf(places[0]);
  const seen: Seen[] = [];
  for (let first = 0; first + 2 < triangles.length; first += 3) {
    const vertices = [0, 1, 2].map((k) => triangles[first + k] ?? 0);
    const [a, b, c] = vertices.map((vertex) => at(places[side], vertex)) as [Vector, Vector, Vector];
    const light = dot(unit(cross(minus(b, a), minus(c, a))), back);
    if (light > 0) {
      const mean = (k: 0 | 1 | 2): number => vertices.reduce((sum, vertex) => sum + (colours[vertex]?.[k] ?? 0) / 3, 0);
      const shade = LEAST_LIGHT + (1 - LEAST_LIGHT) * light;
      seen.push({
        corners: [a, b, c].map((place) => [dot(place, right), dot(place, up)] as const),
        depth: (dot(a, back) + dot(b, back) + dot(c, back)) / 3,
        colour: [shade * mean(0), shade * mean(1), shade * mean(2)],
      });
    }
  }
  return seen.sort((one, other) => one.depth - other.depth);
}

/** The part of a canvas that a picture fills, in pixels. */
export interface Frame {
  readonly middle: readonly [number, number];
  readonly width: number;
  readonly height: number;
}

/** The share of a frame's width and height that stays free, both margins together. */
const MARGIN = 0.06;

/** The number of pixels per unit at which all triangles fit into a frame. */
export function scaleOf(seen: readonly Seen[], { width, height }: Frame): number {
  const farthest = (k: 0 | 1): number =>
    seen.reduce((far, { corners }) => corners.reduce((most, corner) => Math.max(most, Math.abs(corner[k])), far), 1e-9);
  return (0.5 - 0.5 * MARGIN) * Math.min(width / farthest(0), height / farthest(1));
}

/** Paints triangles as large as a frame allows. */
export function paint(context: CanvasRenderingContext2D, seen: readonly Seen[], frame: Frame): void {
  const scale = scaleOf(seen, frame);
  const [left, top] = frame.middle;
  context.lineWidth = 0.6;
  context.lineJoin = 'round';
  for (const { corners, colour } of seen) {
    const [red, green, blue] = colour.map(Math.round);
    context.fillStyle = context.strokeStyle = `rgb(${red} ${green} ${blue})`;
    context.beginPath();
    corners.forEach(([x, y]) => {
      context.lineTo(left + scale * x, top - scale * y);
    });
    context.closePath();
    context.fill();
    // Without a stroke, thin gaps would show between neighbours.
    context.stroke();
  }
}
