/** What the page lends to the picture of the base domain. */
import type { Simplifications, SimplifiedFrom, Watched } from '../compute/watch-messages.ts';
import type { Side } from '../landmarks.ts';
import type { Scheme } from '../report.ts';
import type { MeshDefects } from '../wasm/page.js';
import type { Axes } from './axes.ts';
import type { BasePart } from './parts.ts';

/** How the cameras of the views are turned, for pictures that turn with them. */
export interface TurnedViews {
  /** From now on `heard` hears when a camera has turned; returns what ends it. */
  readonly whenTurned: (heard: () => void) => () => void;
  /** How the camera of a side is turned; `null` while nothing is drawn. */
  readonly axes: (side: Side) => Axes | null;
}

export interface BaseHands extends TurnedViews {
  /** From now on patches light up under the mouse on the meshes; returns what ends it. */
  readonly open: () => () => void;
  /** Turns the view of a side, and the other one where they are linked, in units of the picture's height, y up. */
  readonly orbit: (side: Side, dx: number, dy: number, way: 'smoothly' | 'at once') => void;
  /** Lights up what a part is on both meshes; `null` for nothing. */
  readonly light: (part: BasePart | null) => void;
}

/** One frame of the flows on both meshes. */
export interface FlowFrame {
  /** By side and vertex the places on the scale, 0 to 1, at a moment and at the next one; the same object as long as these are. */
  readonly places: readonly [FactorPlaces, FactorPlaces];
  /** How far it is from the one to the other, 0 to 1. */
  readonly share: number;
  /** By side and vertex the radii of the circles at the first moment, in units of the root of the mesh's area; `null` for no circles. */
  readonly radii: readonly [Float32Array, Float32Array] | null;
}

/** Places on the scale by vertex. */
export interface FactorPlaces {
  readonly from: Float32Array;
  readonly to: Float32Array;
}

/** One stage of the way of both meshes to their landmarks. */
export interface StageFrame {
  /** By side the places of the vertices, and the triangles of the stage. */
  readonly sides: readonly [StageTriangles, StageTriangles];
  /** By side the places that a vertex takes on its way to its landmark, three numbers each; `null` where none is looked at. */
  readonly trails: readonly [Float32Array | null, Float32Array | null];
}

/** Triangles of points. */
export interface StageTriangles {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
}

/** What each part of the method shows on the meshes. */
interface Frames {
  readonly flows: FlowFrame;
  readonly simplifications: StageFrame;
}

/** Who waits for what is computed. */
export interface Listener<T> {
  readonly progress: (share: number) => void;
  readonly done: (answer: T) => void;
  /** In a sentence for the user. */
  readonly failed: (sentence: string) => void;
}

/** What the page lends to a part of the method that is watched. */
export interface WatchHands<W extends keyof Frames> {
  /** Computes it for the map on the page; returns what ends that. */
  readonly start: (listener: Listener<Watched[W]>) => () => void;
  /** Shows a frame on the meshes; `null` for the meshes as before. */
  readonly show: (frame: Frames[W] | null) => void;
}

/** Likewise of the flows, by a discrete conformal structure. */
export interface FlowHands extends Pick<WatchHands<'flows'>, 'show'> {
  readonly start: (listener: Listener<Watched['flows']>, scheme: Scheme) => () => void;
  /** Marks by side the triangles that stopped a flow; `null` for the meshes as before. */
  readonly mark: (stops: Stops | null) => void;
  /** Turns the view of a side to one of the triangles that are marked there. */
  readonly lookAtStop: (side: Side, found: MeshDefects, index: number) => void;
}

/** By side the triangles that stopped a flow; `null` where none did. */
export type Stops = readonly [MeshDefects | null, MeshDefects | null];

/** Likewise of the simplification, from one of both meshes or from both. */
export interface SimplificationHands extends Pick<WatchHands<'simplifications'>, 'show'> {
  readonly start: (listener: Listener<Simplifications>, from: SimplifiedFrom) => () => void;
}
