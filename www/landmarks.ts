/** Points, pairs and suggestions of landmarks: types that the store, the sentences and the views share. */

/** 0 the source, 1 the target. */
export type Side = 0 | 1;
export const SIDES: readonly [0, 1] = [0, 1];

/** A point of a surface: a vertex of the file, or a place in a face. */
export type SurfacePoint =
  | number
  | { readonly face: number; readonly barycentric: readonly [number, number, number] };

export interface Pair {
  readonly points: readonly [SurfacePoint, SurfacePoint];
  readonly label: string;
}

/** A place of one mesh that is worth a landmark. */
export interface Suggestion {
  readonly point: number;
  /** The end of a limb, or far from all landmarks. */
  readonly reason: 'tip' | 'far';
  /** Its name on the page. */
  readonly letter: string;
  /** The letter of the suggestion that looks alike, as left and right do. */
  readonly partner: string | null;
}

/** A landmark file as the core reads it. */
export interface LandmarkFile {
  readonly source?: string;
  readonly target?: string;
  readonly pairs: readonly (readonly [SurfacePoint, SurfacePoint])[];
  readonly labels?: readonly string[];
  readonly ground_truth?: string;
}
