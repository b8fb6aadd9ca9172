/** Files as names with bytes, and the error that refuses them. */
import type { Failure } from './compute/messages.ts';
import type { RepairOffer } from './report.ts';
import type { DemoMesh } from './store/work.ts';

/** The bytes of a file with its name. */
export interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
  /**
   * What came with a mesh file to be laid on the mesh: a picture, or an OBJ file's materials with their pictures, as the core packs them.
   */
  readonly picture?: Uint8Array;
  /** The address from which a link has loaded the file; a file from a disk has none. */
  readonly address?: string;
  /** The demo that the file was built for; other files have none. */
  readonly ofDemo?: DemoMesh;
}

/** Details of a refusal beside its sentence. */
export interface RefusalDetail {
  /** The repair that would help the refused mesh; `null` where there is none. */
  readonly offer?: RepairOffer | null;
  /** What is refused: the file, or the mesh in a file that could be read. */
  readonly what?: 'file' | 'mesh';
  /** The failure of the program, where the file is not at fault. */
  readonly failure?: Failure;
}

/** The error that refuses files; its message is a sentence for the user. */
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
