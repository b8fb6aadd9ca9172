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

/** From the worker. */
export type MatchMessage =
  /** The share that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The report is JSON. */
  | { readonly kind: 'done'; readonly report: string }
  | { readonly kind: 'failed'; readonly failure: Failure };
