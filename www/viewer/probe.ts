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
  /** The base triangle in whose patch the place lies; `null` where nobody asks for patches, or there are none. */
  readonly patch: number | null;
}

/** What the renderer answers; `null` where there is no answer. */
export function probeOf(side: Side, json: string | undefined): Probe | null {
  return json === undefined ? null : { side, ...(JSON.parse(json) as Omit<Probe, 'side'>) };
}
