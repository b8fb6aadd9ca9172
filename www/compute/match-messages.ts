/** The messages between the page and the worker that looks for landmarks. */
import type { Failure } from './messages.ts';

/** The request for a search. */
export interface MatchRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmarks that are held, as a landmark file, which may have no pair. */
  readonly landmarks: string;
}

/** The coarse map of a candidate, for its thumbnail. */
export interface AnswerPicture {
  /** The coarse source's triangles, three vertices each. */
  readonly triangles: Uint32Array;
  /**
   * The places of its vertices on the source and on the target, three coordinates each; the middle of their box is at 0, and half its
   * diagonal is 1.
   */
  readonly places: readonly [Float32Array, Float32Array];
}

/** Found pairs: vertices of the source's and of the target's file. */
export type FoundPairs = readonly (readonly [number, number])[];

/** The messages of the worker. */
export type MatchMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The coarse map of the best pairs so far: for each vertex of the source its place on the target; and those pairs that were found. */
  | { readonly kind: 'preview'; readonly places: Float32Array<ArrayBuffer>; readonly pairs: FoundPairs }
  /** The report as JSON, and a picture of each of its candidates. */
  | { readonly kind: 'done'; readonly report: string; readonly pictures: readonly AnswerPicture[] }
  | { readonly kind: 'failed'; readonly failure: Failure };
