/** Left and right: the planes that mirror the meshes, and pairs that are each other's mirror image. It is a setting of the visit. */
import type { SurfacePoint } from '../landmarks.ts';
import type { MeshFile } from './work.ts';

/** Where a mesh's plane comes from: its shape, an axis of its file through the middle, or the two points that were placed last. */
export type PlaneChoice = 'found' | 'x' | 'y' | 'z' | 'pins';

/** A plane, in the core's numbers of its mesh. */
export interface Plane {
  readonly normal: readonly [number, number, number];
  readonly through: readonly [number, number, number];
}

/** A plane with how well it mirrors its mesh, as the core tells it. */
export interface PlaneAnswer {
  readonly plane: Plane;
  /** Mean distance of the mirror image from the surface, in units of the mesh's size. */
  readonly misfit: number;
  /** Whether the mesh can be said to have this plane for its mirror. */
  readonly fits: boolean;
}

/** The plane of a mesh. */
export interface MeshPlane {
  readonly of: MeshFile;
  readonly choice: PlaneChoice;
  /** `null` where there is none. */
  readonly answer: PlaneAnswer | 'awaited' | null;
}

export interface LeftRight {
  readonly isOn: boolean;
  /** By side; `null` before somebody has asked. */
  readonly planes: readonly [MeshPlane | null, MeshPlane | null];
  /** Ids of pairs that are each other's mirror image; some of them may be gone. */
  readonly twins: readonly (readonly [number, number])[];
}

export const NO_LEFT_RIGHT: LeftRight = { isOn: false, planes: [null, null], twins: [] };

/** What lies across a mesh's plane from a point. */
export interface Across {
  /** `null` where the point is on the midline. */
  readonly point: SurfacePoint | null;
  /** How far off the surface its mirror image was, in units of the mesh's size. */
  readonly distance: number;
  /** The id of the pair whose point stands there already. */
  readonly pair: number | null;
}
