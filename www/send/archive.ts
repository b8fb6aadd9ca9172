/** Zip archives in memory: several named files as one, read within limits. */
import { unzipSync, zipSync } from 'fflate';

/** Files by their names in the archive, in the order in which they are written. */
export type Entries = Readonly<Record<string, Uint8Array>>;

/** What is wrong with an archive. */
export type ArchiveFault = 'no-archive' | 'too-many' | 'too-large';

/** The error of an archive that is not read. */
export class ArchiveRefused extends Error {
  readonly fault: ArchiveFault;

  constructor(fault: ArchiveFault) {
    super(fault);
    this.fault = fault;
  }
}

/** The most entries of an archive: a project has fewer than ten files, a mesh with its textures some dozens. */
export const MOST_ENTRIES = 1000;
/** The most bytes of all files together once they are unpacked. */
export const LARGEST_CONTENT = 2 ** 30;

/** The time of every entry, so that the same files always give the same bytes; zip cannot hold an earlier year. */
const TIME = new Date(1980, 0, 1);

/** Whether these bytes begin like an archive. */
export function isArchive(bytes: Uint8Array): boolean {
  return bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 || bytes[2] === 5);
}

/** Packs and unpacks archives, in a worker or directly. */
export interface Archiver {
  write(entries: Entries): Promise<Uint8Array<ArrayBuffer>>;
  /** Unpacks the named files; the array of bytes is emptied by this. Throws {@link ArchiveRefused}. */
  read(bytes: Uint8Array, names: readonly string[]): Promise<Entries>;
}

/** The requests to the worker for archives. */
export type ArchiveRequest =
  | { readonly kind: 'write'; readonly entries: Entries }
  | { readonly kind: 'read'; readonly bytes: Uint8Array; readonly names: readonly string[] };

/** The answers of the worker. */
export type ArchiveAnswer =
  | { readonly kind: 'written'; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: 'read'; readonly entries: Entries }
  | { readonly kind: 'refused'; readonly fault: ArchiveFault };

/** An archive of these files. */
export function writeArchive(entries: Entries): Uint8Array<ArrayBuffer> {
  return zipSync(entries, { mtime: TIME });
}

/**
 * The files of an archive with the given names, together at most `limit` bytes. Sizes are checked in the archive's directory before any
 * memory is taken, and no file becomes longer than its entry says. The names are only compared: nothing is written to a path. Throws {@link
 * ArchiveRefused}.
 */
export function readArchive(bytes: Uint8Array, names: readonly string[], limit = LARGEST_CONTENT): Entries {
  let count = 0;
  let size = 0;
  try {
    return unzipSync(bytes, {
      filter: ({ name, originalSize }) => {
        count++;
        if (count > MOST_ENTRIES) {
          throw new ArchiveRefused('too-many');
        }
        if (!names.includes(name)) {
          return false;
        }
        size += originalSize;
        if (size > limit) {
          throw new ArchiveRefused('too-large');
        }
        return true;
      },
    });
  } catch (thrown) {
    throw thrown instanceof ArchiveRefused ? thrown : new ArchiveRefused('no-archive');
  }
}
