/** Files by their names, and the reasons to refuse them. */
import type { Failure } from './compute/messages.ts';
import type { RepairOffer } from './report.ts';

/** Some named bytes. */
export interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** What comes with the mesh in them to be laid on it: a picture, or an OBJ file's materials with theirs, as the core packs them. */
  readonly picture?: Uint8Array;
  /** Where a link found them; there is none for a file from a disk. */
  readonly address?: string;
}

/** What there is to know of a refusal beside its sentence. */
export interface RefusalDetail {
  /** The repair of a mesh that would help; `null` where there is none. */
  readonly offer?: RepairOffer | null;
  /** What is refused: the file, or the mesh in it, which was read. */
  readonly what?: 'file' | 'mesh';
  /** Where it was not the file's fault. */
  readonly failure?: Failure;
}

/** A reason to refuse files, as a sentence. */
export class FileRefused extends Error {
  readonly offer: RepairOffer | null;
  readonly what: 'file' | 'mesh';
  readonly failure: Failure | null;

  constructor(sentence: string, { offer = null, what = 'file', failure }: RefusalDetail = {}) {
    super(sentence);
    this.offer = offer;
    this.what = what;
    this.failure = failure ?? null;
  }
}

/** The ending of a file's name, in lower case and without its dot. */
export function endingOf(name: string): string {
  return /\.([^./\\]+)$/.exec(name)?.[1]?.toLowerCase() ?? '';
}
