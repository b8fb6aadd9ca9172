/** What the map says about a place. */
import type { Side, SurfacePoint } from '../landmarks.ts';

/** A point in the coordinates of a mesh's file. */
export type Position = readonly [number, number, number];

/** The answer about a place of one mesh, with its partner. */
export interface Probe {
  /** The side that was asked about. */
  readonly side: Side;
  /** The place on the source and on the target. */
  readonly points: readonly [SurfacePoint, SurfacePoint];
  /** The positions of both places, in the files' coordinates. */
  readonly positions: readonly [Position, Position];
  /** The distortion of the map at the place, 1 for none; `null` where it is not known. */
  readonly distortion: number | null;
  /** The values of the shown heat map at the place: one of the map, or one on each mesh; `null` where no heat map is shown. */
  readonly heat: readonly number[] | null;
  /** The base triangle in whose patch the place lies; `null` while patches are not wanted, and where there are none. */
  readonly patch: number | null;
}

/** The renderer's answer. */
interface Answer extends Pick<Probe, 'points' | 'positions' | 'patch'> {
  /** The corners of the map's triangle at the place, as points of the map, and their weights. */
  readonly corners: readonly [number, number, number];
  readonly weights: readonly [number, number, number];
  /** The place on each side on the scale of a heat map of the vertices; `null` where none is shown. */
  readonly places: readonly [number | null, number | null];
}

/** The values from which questions about places are answered. */
export interface Known {
  /** The distortion at each point of the map; empty where it is not known. */
  readonly distortion: Float32Array;
  /** The values of the shown heat map at the points of the map; `null` where it is not one of the map. */
  readonly values: Float32Array | null;
  /** The value at a place on the scale of the shown heat map of the vertices; `null` where none is shown. */
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

/** The answer about a place; `null` where the renderer has none. */
export function probeOf(side: Side, json: string | undefined, known: Known): Probe | null {
  if (json === undefined) {
    return null;
  }
  const answer = JSON.parse(json) as Answer;
  const { points, positions, patch, corners, weights } = answer;
  const distortion = known.distortion.length === 0 ? null : blend(known.distortion, corners, weights);
  return { side, points, positions, patch, distortion, heat: heatOf(answer, known) };
}
