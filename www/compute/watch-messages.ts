/** What the page and the worker that does parts of the method again, to be looked at, say to each other. */
import type { OtherMap, RunOptions, Scheme } from '../report.ts';
import type { CollapsedMesh } from '../wasm/core.js';
import type { Failure, RunOutput } from './messages.ts';

/**
 * What can be looked at: the flows of both meshes to their flat metrics, how both are simplified to their landmarks, and other maps of
 * the same meshes and landmarks.
 */
export type Watchable = 'flows' | 'simplifications' | 'other-map';

/** What is simplified: each mesh by itself; or one of both, drawn on both by the map, or the source where both decide. */
export type SimplifiedFrom = 'each' | CollapsedMesh;

/** What is wanted of a map. */
export interface WatchRequest {
  readonly wanted: Watchable;
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmark file of the map. */
  readonly landmarks: string;
  /** Curvature of each landmark's cone, in radians. */
  readonly cones: Float64Array;
  /** The discrete conformal structure of flows; `null` where none is wanted. */
  readonly scheme: Scheme | null;
  /** What simplifications begin with, and the map file that draws them on both meshes; `null` for each mesh by itself. */
  readonly carried: { readonly from: CollapsedMesh; readonly map: Uint8Array } | null;
  /** Which other map is wanted, and what the map was made with; `null` where none is. */
  readonly other: OtherRequest | null;
}

/** Another map of the same meshes and landmarks. */
export interface OtherRequest {
  readonly which: OtherMap;
  readonly options: RunOptions;
  /** The demo whose meshes these are, by its id; `null` for other meshes. */
  readonly demo: string | null;
}

/** A flow after a Newton step; the counts are of all steps so far. */
export interface FlowMoment {
  readonly step: number;
  /** Largest curvature error, in radians. */
  readonly residual: number;
  readonly cgIterations: number;
  readonly edgeFlips: number;
}

/** The flow of one mesh. */
export interface SideFlow {
  /** From before the first step on. */
  readonly moments: readonly FlowMoment[];
  /** Whether the last moment has the curvatures that were asked for. */
  readonly converged: boolean;
  /** The faces that it stopped at, by their numbers in the file. */
  readonly stops: readonly number[];
  /** What a view shows of them, for `unpackDefects`. */
  readonly packedStops: Uint8Array;
  /** Logarithm of the conformal factor, moment after moment, by vertex of the mesh. */
  readonly logFactors: Float32Array;
  /** By vertex the radii of the circles before the first step, in units of the root of the mesh's area; none where there are no circles. */
  readonly radii: Float32Array;
  /** Gaussian curvature by vertex before the first step and at the last moment, in units of a sphere's of the same area. */
  readonly curvatures: readonly [Float32Array, Float32Array];
}

/** The flows of the source and of the target. */
export type Flows = readonly [SideFlow, SideFlow];

/** One mesh on its way to its landmarks; its vertices do not move. */
export interface Simplification {
  /** Where its vertices are, three numbers each. */
  readonly positions: Float32Array;
  /** The triangles of all stages, one stage after the other, the whole mesh first. */
  readonly triangles: Uint32Array;
  /** How many triangles each stage has. */
  readonly counts: Uint32Array;
  /** All collapses in their order, two vertices each: the one that went, and the one that it went onto. */
  readonly collapses: Uint32Array;
}

/** The source and the target on their way. */
export type Simplifications = readonly [Simplification, Simplification];

/** What the views show of another map, and its report as JSON. */
export type OtherOutput = Pick<RunOutput, 'sides' | 'uvs' | 'distortion' | 'truth' | 'triangles' | 'report'>;

/** What each wish is answered with. */
export interface Watched {
  readonly flows: Flows;
  readonly simplifications: Simplifications;
  readonly 'other-map': OtherOutput;
}

/** From the worker. */
export type WatchMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The answer is that of the wish. */
  | { readonly kind: 'done'; readonly answer: Watched[Watchable] }
  | { readonly kind: 'failed'; readonly failure: Failure };
