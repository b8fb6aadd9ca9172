/** Left and right: the planes that mirror the meshes, and the pairs that are each other's mirror image. This is a setting of the visit. */
import type { SurfacePoint } from '../landmarks.ts';
import type { MeshFile } from './work.ts';

/** The origin of a mesh's plane: its shape, an axis of its file through the middle, or the two points that were placed last. */
export type PlaneChoice = 'found' | 'x' | 'y' | 'z' | 'pins';

/** A plane, in the coordinates that the core has for its mesh. */
export interface Plane {
  readonly normal: readonly [number, number, number];
  readonly through: readonly [number, number, number];
}

/** A plane as the core returns it, with how well it mirrors its mesh. */
export interface PlaneAnswer {
  readonly plane: Plane;
  /** The mean distance of the mirror image from the surface, in units of the mesh's size. */
  readonly misfit: number;
  /** Whether the mesh can be called symmetric about this plane. */
  readonly fits: boolean;
}

/** The plane of a mesh. */
export interface MeshPlane {
  readonly of: MeshFile;
  readonly choice: PlaneChoice;
  /** The core's answer; `null` where there is no plane. */
  readonly answer: PlaneAnswer | 'awaited' | null;
}

export interface LeftRight {
  readonly isOn: boolean;
  /** The plane of each side; `null` before it was asked for. */
  readonly planes: readonly [MeshPlane | null, MeshPlane | null];
  /** Ids of the pairs that are each other's mirror image; some of these pairs may be gone. */
  readonly twins: readonly (readonly [number, number])[];
}

export const NO_LEFT_RIGHT: LeftRight = { isOn: false, planes: [null, null], twins: [] };

/** The mirror image of a point across a mesh's plane. */
export interface Across {
  /** The point across; `null` where the given point is on the midline. */
  readonly point: SurfacePoint | null;
  /** The distance of the mirror image from the surface, in units of the mesh's size. */
  readonly distance: number;
  /** The id of the pair whose point is already there; `null` for none. */
  readonly pair: number | null;
}
