/** Zip archives in memory: several named files as one, read within bounds. */
import { unzipSync, zipSync } from 'fflate';

/** Files by their names in the archive, in the order in which they are written. */
export type Entries = Readonly<Record<string, Uint8Array>>;

/** What is wrong with an archive. */
export type ArchiveFault = 'no-archive' | 'too-many' | 'too-large';

/** An archive that is not read. */
export class ArchiveRefused extends Error {
  readonly fault: ArchiveFault;

  constructor(fault: ArchiveFault) {
    super(fault);
    this.fault = fault;
  }
}

/** A project has fewer than ten files; a mesh with its textures has some dozens. */
export const MOST_ENTRIES = 1000;
/** In bytes, of all files together once they are unpacked. */
export const LARGEST_CONTENT = 2 ** 30;

/** The same for every archive, so that the same files make the same bytes; zip knows no earlier year. */
const TIME = new Date(1980, 0, 1);

/** Whether these bytes begin as an archive does. */
export function isArchive(bytes: Uint8Array): boolean {
  return bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 || bytes[2] === 5);
}

/** Where archives are packed and unpacked, so that the page can do it beside its own work. */
export interface Archiver {
  write(entries: Entries): Promise<Uint8Array<ArrayBuffer>>;
  /** Takes the bytes, which are gone afterwards. Throws {@link ArchiveRefused}. */
  read(bytes: Uint8Array, names: readonly string[]): Promise<Entries>;
}

/** What a worker for archives is asked. */
export type ArchiveRequest =
  | { readonly kind: 'write'; readonly entries: Entries }
  | { readonly kind: 'read'; readonly bytes: Uint8Array; readonly names: readonly string[] };

/** What the worker answers. */
export type ArchiveAnswer =
  | { readonly kind: 'written'; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: 'read'; readonly entries: Entries }
  | { readonly kind: 'refused'; readonly fault: ArchiveFault };

/** One archive of all these files. */
export function writeArchive(entries: Entries): Uint8Array<ArrayBuffer> {
  return zipSync(entries, { mtime: TIME });
}

/**
 * Those files of an archive whose names are asked for, `limit` bytes at most together. Sizes are judged by the archive's directory before any memory is
 * taken, and no file becomes longer than its entry says. Names are names: nothing is written anywhere by them. Throws
 * {@link ArchiveRefused}.
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
