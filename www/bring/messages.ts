/** What the page and the worker that brings files across say to each other. */
import type { Failure } from '../compute/messages.ts';
import type { GivenFileReport, GivenKind, MeshSide, TransferWish } from '../wasm/core.js';

export type { GivenFileReport, TransferWhat, TransferWish } from '../wasm/core.js';

/** What a file may be taken for. */
export type Kind = GivenKind;

/** What a map is made of: its file, and those of its meshes. */
export interface MapBytes {
  readonly map: Uint8Array;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
}

/** To the worker, which answers once. It reads the files itself, so that none passes through the page. */
export type BringRequest = { readonly module: WebAssembly.Module; readonly files: readonly Blob[] } & (
  | { readonly kind: 'look' }
  | ({ readonly kind: 'bring'; readonly wish: TransferWish } & MapBytes)
);

/** What came across: one file, or an archive of several. */
export interface Brought {
  /** The usual name of the only file; `null` for an archive. */
  readonly only: string | null;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** How many files there are. */
  readonly count: number;
  /** What there is to know about them; `null` for nothing. */
  readonly remark: string | null;
}

/** Why nothing came, with the file at fault: the number of a given one, or a mesh's; `null` where it is none's. */
export interface BringFailure extends Failure {
  readonly file: number | MeshSide | null;
}

/** By request what is answered: by file what it may hold, or what came across. */
export interface Answers {
  readonly look: readonly GivenFileReport[];
  readonly bring: Brought;
}

/** From the worker; the last two are last. */
export type BringMessage =
  | { readonly kind: 'progress'; readonly share: number }
  | { readonly kind: 'done'; readonly answer: Answers[keyof Answers] }
  | { readonly kind: 'failed'; readonly failure: BringFailure };
