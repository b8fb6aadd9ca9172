/** The messages between the page and the worker that brings files across. */
import type { Failure } from '../compute/messages.ts';
import type { GivenFileReport, GivenKind, MeshSide, TransferWish } from '../wasm/core.js';

export type { GivenFileReport, TransferWhat, TransferWish } from '../wasm/core.js';

/** What a file may be taken for. */
export type Kind = GivenKind;

/** The files of which a map is opened: its own, and those of its meshes. */
export interface MapBytes {
  readonly map: Uint8Array;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
}

/** The request to the worker, which answers once. It reads the files itself, so that none passes through the page. */
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
  /** A sentence about the files; `null` for none. */
  readonly remark: string | null;
}

/** Why nothing was brought across, with the file at fault: the index of a given one, or a mesh; `null` where no file is at fault. */
export interface BringFailure extends Failure {
  readonly file: number | MeshSide | null;
}

/** The answer to each kind of request: what each file may hold, or what was brought across. */
export interface Answers {
  readonly look: readonly GivenFileReport[];
  readonly bring: Brought;
}

/** The messages of the worker; it ends after `done` or `failed`. */
export type BringMessage =
  | { readonly kind: 'progress'; readonly share: number }
  | { readonly kind: 'done'; readonly answer: Answers[keyof Answers] }
  | { readonly kind: 'failed'; readonly failure: BringFailure };
