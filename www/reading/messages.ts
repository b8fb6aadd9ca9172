/** The messages between the page and the workers that read files and meshes. */
import type { Failure } from '../compute/messages.ts';
import type { NamedBytes } from '../named-file.ts';
import type { RepairOffer } from '../report.ts';
import type { Allowed } from '../store/refused.ts';
import type { LandmarkContent } from '../wasm/page.js';

/** Bytes in a buffer of their own, which can be transferred. */
export type OwnBytes = Uint8Array<ArrayBuffer>;

/** A mesh that was read, and repaired where it had to be. */
export interface GoodMesh {
  readonly kind: 'good';
  /** The mesh as both modules pack it. */
  readonly packed: OwnBytes;
  /** A sentence about the repairs, without a full stop; empty where the mesh was good as given. */
  readonly repairs: string;
  /** Sentences about colours and pictures of the mesh that cannot be used, each without a full stop. */
  readonly remarks: readonly string[];
}

/** A reason to refuse a file. */
export interface Refusal {
  readonly sentence: string;
  readonly offer: RepairOffer | null;
  readonly what: 'file' | 'mesh';
  /** The failure of the program, where the file is not at fault. */
  readonly failure?: Failure;
}

/** A mesh that was refused. */
export interface BadMesh extends Refusal {
  readonly kind: 'bad';
  /** The defects of the mesh, as the core packs them; `null` where no mesh can be shown. */
  readonly defects: OwnBytes | null;
}

/** The result of reading a mesh file. */
export type MeshReading = GoodMesh | BadMesh;

/** A mesh file with the result of reading it. */
export interface ReadFile {
  readonly file: NamedBytes;
  readonly reading: MeshReading;
}

/** A file with what it holds. */
export interface SortedFile extends NamedBytes {
  readonly content: 'mesh' | 'map' | LandmarkContent;
}

/** A demo as files. */
export interface DemoFiles {
  readonly meshes: readonly [ReadFile, ReadFile];
  readonly landmarks: NamedBytes;
}

/** The mirror image of a target. */
export interface MirroredMesh {
  readonly mesh: ReadFile;
  /** A landmark file with the points on the mirror image. */
  readonly landmarks: OwnBytes;
}

/** The questions to the worker of files, which has the page's module. */
export type FileQuestion =
  /** Which files there are once zips are unpacked and the parts of meshes packed into them, and what each holds. */
  | { readonly kind: 'sort'; readonly files: readonly NamedBytes[] }
  | { readonly kind: 'demo'; readonly id: string };

/** The questions to the worker of meshes, which has the core; meshes of the page are sent to it packed. */
export type MeshQuestion =
  | { readonly kind: 'mesh'; readonly file: NamedBytes; readonly allowed: Allowed }
  /** What was wrong with the mesh of a file before it was repaired. */
  | { readonly kind: 'repairs'; readonly bytes: Uint8Array; readonly mesh: Uint8Array }
  /** The mirror image of a mesh, with the second points of the landmark file `landmarks` carried along; `name` is the image's name. */
  | { readonly kind: 'mirror'; readonly mesh: Uint8Array; readonly landmarks: Uint8Array; readonly name: string }
  /** Places that are worth a landmark beside the `marked` ones, which are a JSON array of points. */
  | { readonly kind: 'suggest'; readonly mesh: Uint8Array; readonly marked: string }
  /** A plane that mirrors a mesh; `wish` says in the core's form which one. */
  | { readonly kind: 'plane'; readonly mesh: Uint8Array; readonly wish: string };

export type Question = FileQuestion | MeshQuestion;

/** Whether the worker of files answers a question, rather than that of meshes. */
export function isOfFiles(question: Question): question is FileQuestion {
  return question.kind === 'sort' || question.kind === 'demo';
}

/** The messages to a worker: its module once, and questions before it or after it. */
export type ReaderRequest<Asked extends Question = Question> =
  | { readonly kind: 'module'; readonly module: WebAssembly.Module }
  | { readonly kind: 'question'; readonly id: number; readonly question: Asked };

/** The answer to each kind of question. */
export interface Answers {
  readonly sort: readonly SortedFile[];
  readonly mesh: MeshReading;
  readonly repairs: OwnBytes;
  readonly mirror: MirroredMesh;
  /** The suggestions, as the core's JSON. */
  readonly suggest: string;
  /** The plane, as the core's JSON. */
  readonly plane: string;
  /** The demo; `null` where there is none of that name. */
  readonly demo: DemoFiles | null;
}

/** The messages of a worker: the outcome of the question with the same id, and the memory of its module in bytes. */
export type ReaderAnswer = { readonly id: number; readonly memory: number } & (
  | { readonly kind: 'answer'; readonly answer: Answers[keyof Answers] }
  | { readonly kind: 'refused'; readonly refusal: Refusal }
  /** The worker broke off, and must not be asked again. */
  | { readonly kind: 'failed'; readonly failure: Failure }
);
