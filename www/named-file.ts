/** Files by their names, and the reasons to refuse them. */

/** Some named bytes. */
export interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** Where a link found them; there is none for a file from a disk. */
  readonly address?: string;
}

/** A reason to refuse files, as a sentence. */
export class FileRefused extends Error {}

/** The ending of a file's name, in lower case and without its dot. */
export function endingOf(name: string): string {
  return /\.([^./\\]+)$/.exec(name)?.[1]?.toLowerCase() ?? '';
}
