/** The messages between the page and the worker that computes parts of the method again. */
import type { OtherMap, RunOptions, Scheme } from '../report.ts';
import type { CollapsedMesh } from '../wasm/core.js';
import type { Failure, RunOutput } from './messages.ts';

/**
 * What can be watched: the flows of both meshes to their flat metrics, the simplification of both to their landmarks, and other maps of the
 * same meshes and landmarks.
 */
export type Watchable = 'flows' | 'simplifications' | 'other-map';

/** Which mesh is simplified: `each` by itself, or the one that the map carries to the other, or the source where both shapes decide. */
export type SimplifiedFrom = 'each' | CollapsedMesh;

/** A request to the worker. */
export interface WatchRequest {
  readonly wanted: Watchable;
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmark file of the map. */
  readonly landmarks: string;
  /** The curvature of each landmark's cone, in radians. */
  readonly cones: Float64Array;
  /** The discrete conformal structure of the flows; `null` where no flows are wanted. */
  readonly scheme: Scheme | null;
  /**
   * The mesh with which the simplification begins, and the map file that carries it to the other; `null` where each mesh is simplified by
   * itself.
   */
  readonly carried: { readonly from: CollapsedMesh; readonly map: Uint8Array } | null;
  /** The other map that is wanted, and what the map on the page was made with; `null` where no other map is wanted. */
  readonly other: OtherRequest | null;
}

/** Another map of the same meshes and landmarks. */
export interface OtherRequest {
  readonly which: OtherMap;
  readonly options: RunOptions;
  /** The demo whose meshes these are, by its id; `null` for other meshes. */
  readonly demo: string | null;
}

/** The state of a flow after a Newton step; the counts are of all steps so far. */
export interface FlowMoment {
  readonly step: number;
  /** The largest curvature error, in radians. */
  readonly residual: number;
  readonly cgIterations: number;
  readonly edgeFlips: number;
}

/** The flow of one mesh. */
export interface SideFlow {
  /** The moments of the flow, the first one before the first step. */
  readonly moments: readonly FlowMoment[];
  /** Whether the curvatures at the last moment are those that were asked for. */
  readonly converged: boolean;
  /** The faces that the flow stopped at, by their numbers in the file. */
  readonly stops: readonly number[];
  /** The marks of these faces in a view, for `unpackDefects`. */
  readonly packedStops: Uint8Array;
  /** The logarithm of the conformal factor at each vertex of the mesh, moment after moment. */
  readonly logFactors: Float32Array;
  /**
   * The radius of the circle at each vertex before the first step, in units of the root of the mesh's area; empty where there are no
   * circles.
   */
  readonly radii: Float32Array;
  /**
   * The Gaussian curvature at each vertex before the first step and at the last moment, in units of the curvature of a sphere of the same
   * area.
   */
  readonly curvatures: readonly [Float32Array, Float32Array];
}

/** The flows of the source and of the target. */
export type Flows = readonly [SideFlow, SideFlow];

/** The simplification of one mesh to its landmarks; its vertices do not move. */
export interface Simplification {
  /** The positions of the vertices, three numbers each. */
  readonly positions: Float32Array;
  /** The triangles of all stages, one stage after the other, the whole mesh first. */
  readonly triangles: Uint32Array;
  /** How many triangles each stage has. */
  readonly counts: Uint32Array;
  /** All collapses in their order, two vertices each: the one that is removed, and the one that it is moved onto. */
  readonly collapses: Uint32Array;
}

/** The simplifications of the source and of the target. */
export type Simplifications = readonly [Simplification, Simplification];

/** What the views show of another map, and its report as JSON. */
export type OtherOutput = Pick<RunOutput, 'sides' | 'uvs' | 'distortion' | 'truth' | 'triangles' | 'report'>;

/** The answer to each kind of request. */
export interface Watched {
  readonly flows: Flows;
  readonly simplifications: Simplifications;
  readonly 'other-map': OtherOutput;
}

/** The messages of the worker. */
export type WatchMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The answer to the request. */
  | { readonly kind: 'done'; readonly answer: Watched[Watchable] }
  | { readonly kind: 'failed'; readonly failure: Failure };
