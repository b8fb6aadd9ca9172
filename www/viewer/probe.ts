/** What the map says of a place. */
import type { Side, SurfacePoint } from '../landmarks.ts';

/** A point of a mesh's file in its own coordinates. */
export type Position = readonly [number, number, number];

/** A place of one mesh that the map was asked about, with its partner. */
export interface Probe {
  /** The side that was asked. */
  readonly side: Side;
  /** On the source and on the target. */
  readonly points: readonly [SurfacePoint, SurfacePoint];
  /** Likewise, in the files' coordinates. */
  readonly positions: readonly [Position, Position];
  /** Distortion of the map there, 1 for none; `null` where it is not known. */
  readonly distortion: number | null;
  /** What the heat map that is shown has there: one value of the map, or one on each mesh; `null` where none is shown. */
  readonly heat: readonly number[] | null;
  /** The base triangle in whose patch the place lies; `null` where nobody asks for patches, or there are none. */
  readonly patch: number | null;
}

/** What the renderer answers. */
interface Answer extends Pick<Probe, 'points' | 'positions' | 'patch'> {
  /** The points of the map's triangle there, and their weights. */
  readonly corners: readonly [number, number, number];
  readonly weights: readonly [number, number, number];
  /** By side the place on the scale of a heat map of the vertices; `null` where none is shown. */
  readonly places: readonly [number | null, number | null];
}

/** What is known of the places that are asked for. */
export interface Known {
  /** By point of the map; empty where it is not known. */
  readonly distortion: Float32Array;
  /** Values of the heat map that is shown, by point of the map. */
  readonly values: Float32Array | null;
  /** The value at a place on the scale of the heat map of the vertices that is shown. */
  readonly valueAt: ((place: number) => number) | null;
}

function heatOf({ corners, weights, places }: Answer, { values, valueAt }: Known): readonly number[] | null {
  if (values !== null) {
    return [blend(values, corners, weights)];
  }
  const [source, target] = places;
  return valueAt === null || source === null || target === null ? null : [valueAt(source), valueAt(target)];
}

function blend(values: Float32Array, corners: Answer['corners'], weights: Answer['weights']): number {
  return corners.reduce((sum, corner, k) => sum + (weights[k] ?? 0) * (values[corner] ?? 0), 0);
}

/** What the map says of a place; `null` where the renderer has no answer. */
export function probeOf(side: Side, json: string | undefined, known: Known): Probe | null {
  if (json === undefined) {
    return null;
  }
  const answer = JSON.parse(json) as Answer;
  const { points, positions, patch, corners, weights } = answer;
  const distortion = known.distortion.length === 0 ? null : blend(known.distortion, corners, weights);
  return { side, points, positions, patch, distortion, heat: heatOf(answer, known) };
}
