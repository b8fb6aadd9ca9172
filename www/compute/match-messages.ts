/** What the page and the worker that looks for landmarks say to each other. */
import type { Failure } from './messages.ts';

/** What is matched. */
export interface MatchRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmarks that are held: a landmark file, which may have no pair. */
  readonly landmarks: string;
}

/** The coarse map of a candidate, to be looked at. */
export interface AnswerPicture {
  /** The coarse source's triangles, three vertices each. */
  readonly triangles: Uint32Array;
  /** Where its vertices are on the source and on the target, three coordinates each: the middle of their box is 0, half its diagonal 1. */
  readonly places: readonly [Float32Array, Float32Array];
}

/** From the worker. */
export type MatchMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The report is JSON; a picture of each of its candidates. */
  | { readonly kind: 'done'; readonly report: string; readonly pictures: readonly AnswerPicture[] }
  | { readonly kind: 'failed'; readonly failure: Failure };
