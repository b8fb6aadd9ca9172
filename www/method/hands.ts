/** What the pictures of the method need of the page. */
import type { Simplifications, SimplifiedFrom, Watched } from '../compute/watch-messages.ts';
import type { Side } from '../landmarks.ts';
import type { Scheme } from '../report.ts';
import type { MeshDefects } from '../wasm/page.js';
import type { Axes } from './axes.ts';
import type { BasePart } from './parts.ts';

/** The orientations of the views' cameras, for pictures that turn with them. */
export interface TurnedViews {
  /** Calls `heard` whenever a camera has turned; the returned function ends that. */
  readonly whenTurned: (heard: () => void) => () => void;
  /** The axes of the camera of a side; `null` while nothing is drawn. */
  readonly axes: (side: Side) => Axes | null;
}

export interface BaseHands extends TurnedViews {
  /** Lets patches light up under the mouse on the meshes; the returned function ends that. */
  readonly open: () => () => void;
  /** Turns the view of a side, and the other one where they are linked, in units of the picture's height, y up. */
  readonly orbit: (side: Side, dx: number, dy: number, way: 'smoothly' | 'at once') => void;
  /** Lights up a part of the base domain on both meshes; `null` lights up nothing. */
  readonly light: (part: BasePart | null) => void;
}

/** One frame of the flows on both meshes. */
export interface FlowFrame {
  /** The places of each side's vertices on the scale at a moment and at the next one; the same object as long as these stay the same. */
  readonly places: readonly [FactorPlaces, FactorPlaces];
  /** How far the frame is from the one moment to the next, from 0 to 1. */
  readonly share: number;
  /**
   * The radii of each side's circles at the first moment, by vertex, in units of the root of the mesh's area; `null` where there are no
   * circles.
   */
  readonly radii: readonly [Float32Array, Float32Array] | null;
}

/** The places of the vertices on the scale, from 0 to 1, at a moment and at the next one. */
export interface FactorPlaces {
  readonly from: Float32Array;
  readonly to: Float32Array;
}

/** One stage in the simplification of both meshes to their landmarks. */
export interface StageFrame {
  /** The positions of each side's vertices, and the triangles of the stage. */
  readonly sides: readonly [StageTriangles, StageTriangles];
  /**
   * For each side the positions that a vertex takes until it is at its landmark, three numbers each; `null` where no vertex is looked at.
   */
  readonly trails: readonly [Float32Array | null, Float32Array | null];
}

/** Triangles between points. */
export interface StageTriangles {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
}

/** What each part of the method shows on the meshes. */
interface Frames {
  readonly flows: FlowFrame;
  readonly simplifications: StageFrame;
}

/** The listener to a computation. */
export interface Listener<T> {
  readonly progress: (share: number) => void;
  readonly done: (answer: T) => void;
  /** Called with a sentence for the user. */
  readonly failed: (sentence: string) => void;
}

/** What a part of the method that is watched needs of the page. */
export interface WatchHands<W extends keyof Frames> {
  /** Computes the part for the map on the page; the returned function ends that. */
  readonly start: (listener: Listener<Watched[W]>) => () => void;
  /** Shows a frame on the meshes; `null` shows the meshes as they were before. */
  readonly show: (frame: Frames[W] | null) => void;
}

/** The same for the flows, with a discrete conformal structure. */
export interface FlowHands extends Pick<WatchHands<'flows'>, 'show'> {
  readonly start: (listener: Listener<Watched['flows']>, scheme: Scheme) => () => void;
  /** Marks on each side the triangles that stopped a flow; `null` shows the meshes as they were before. */
  readonly mark: (stops: Stops | null) => void;
  /** Turns the view of a side to one of the marked triangles. */
  readonly lookAtStop: (side: Side, found: MeshDefects, index: number) => void;
}

/** The triangles on each side that stopped a flow; `null` where none did. */
export type Stops = readonly [MeshDefects | null, MeshDefects | null];

/** The same for the simplification, which starts from one of the meshes or from both. */
export interface SimplificationHands extends Pick<WatchHands<'simplifications'>, 'show'> {
  readonly start: (listener: Listener<Simplifications>, from: SimplifiedFrom) => () => void;
}
