/** What a link that was opened waits for. */
import type { Side } from '../landmarks.ts';

/** Files of one host. */
export interface HostFiles {
  readonly host: string;
  readonly names: readonly string[];
}

/** A file that must be given by hand. */
export interface Missing {
  readonly side: Side;
  readonly name: string;
}

export type Receiving =
  | { readonly kind: 'nothing' }
  /** For a click: these files would be fetched. */
  | { readonly kind: 'click'; readonly hosts: readonly HostFiles[] }
  /** For a file on its way; in bytes, `expected` is `null` where the server does not say how many come. */
  | { readonly kind: 'fetch'; readonly name: string; readonly loaded: number; readonly expected: number | null }
  /** For files from whoever opened the link. */
  | { readonly kind: 'files'; readonly missing: readonly Missing[] };
