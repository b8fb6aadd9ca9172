/** What an opened link waits for. */
import type { Side } from '../landmarks.ts';

/** Files from one host. */
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
  /** The user's click, before these files are fetched. */
  | { readonly kind: 'click'; readonly hosts: readonly HostFiles[] }
  /** A file that is being loaded, in bytes; `expected` is `null` where the server does not state the size. */
  | { readonly kind: 'fetch'; readonly name: string; readonly loaded: number; readonly expected: number | null }
  /** Files that the user must give. */
  | { readonly kind: 'files'; readonly missing: readonly Missing[] };
