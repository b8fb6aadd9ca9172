/** What the page and the worker that runs the flows of both meshes say to each other. */
import type { Failure } from './messages.ts';

/** What flows. */
export interface FlowRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmark file of the map. */
  readonly landmarks: string;
  /** Curvature of each landmark's cone, in radians. */
  readonly cones: Float64Array;
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
  /** Logarithm of the conformal factor, moment after moment, by vertex of the mesh. */
  readonly logFactors: Float32Array;
}

/** The flows of the source and of the target. */
export type Flows = readonly [SideFlow, SideFlow];

/** From the worker. */
export type FlowMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  | { readonly kind: 'done'; readonly flows: Flows }
  | { readonly kind: 'failed'; readonly failure: Failure };
