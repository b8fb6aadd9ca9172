/** What the page and the workers that read files and meshes say to each other. */
import type { Failure } from '../compute/messages.ts';
import type { NamedBytes } from '../named-file.ts';
import type { RepairOffer } from '../report.ts';
import type { Allowed } from '../store/refused.ts';
import type { LandmarkContent } from '../wasm/page.js';

/** Bytes that can be handed over. */
export type OwnBytes = Uint8Array<ArrayBuffer>;

/** A mesh that was read, and repaired where it had to be. */
export interface GoodMesh {
  readonly kind: 'good';
  /** As both modules pack it. */
  readonly packed: OwnBytes;
  /** What was repaired, in a sentence without a full stop; empty where the mesh was good as given. */
  readonly repairs: string;
  /** What of its colours and pictures cannot be used, each in a sentence without a full stop. */
  readonly remarks: readonly string[];
}

/** A reason to refuse a file. */
export interface Refusal {
  readonly sentence: string;
  readonly offer: RepairOffer | null;
  readonly what: 'file' | 'mesh';
  /** Where it was not the file's fault. */
  readonly failure?: Failure;
}

/** A mesh that was refused. */
export interface BadMesh extends Refusal {
  readonly kind: 'bad';
  /** What is wrong with it, as the core packs it; `null` where there is nothing to be seen. */
  readonly defects: OwnBytes | null;
}

/** What became of a mesh file. */
export type MeshReading = GoodMesh | BadMesh;

/** A mesh file with what became of it. */
export interface ReadFile {
  readonly file: NamedBytes;
  readonly reading: MeshReading;
}

/** A file by what it holds. */
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
  /** A landmark file with the points carried along. */
  readonly landmarks: OwnBytes;
}

/** What the worker of files is asked, which has the page's module. */
export type FileQuestion =
  /** Which files there are when zips are unpacked and the parts of meshes packed into them, and what each holds. */
  | { readonly kind: 'sort'; readonly files: readonly NamedBytes[] }
  | { readonly kind: 'demo'; readonly id: string };

/** What the worker of meshes is asked, which has the core; meshes of the page go to it as they are packed. */
export type MeshQuestion =
  | { readonly kind: 'mesh'; readonly file: NamedBytes; readonly allowed: Allowed }
  /** What was wrong with a file whose mesh was repaired. */
  | { readonly kind: 'repairs'; readonly bytes: Uint8Array; readonly mesh: Uint8Array }
  /** `landmarks` is a landmark file, whose second points are the target's; `name` is the image's. */
  | { readonly kind: 'mirror'; readonly mesh: Uint8Array; readonly landmarks: Uint8Array; readonly name: string }
  /** At most `count` places that are worth a landmark beside the `marked` ones, a JSON array of points. */
  | { readonly kind: 'suggest'; readonly mesh: Uint8Array; readonly marked: string }
  /** A plane that mirrors a mesh; `wish` says which in the core's words. */
  | { readonly kind: 'plane'; readonly mesh: Uint8Array; readonly wish: string };

export type Question = FileQuestion | MeshQuestion;

/** Whether the worker of files answers a question, and not that of meshes. */
export function isOfFiles(question: Question): question is FileQuestion {
  return question.kind === 'sort' || question.kind === 'demo';
}

/** To a worker: its module once, and questions, before it or after. */
export type ReaderRequest<Asked extends Question = Question> =
  | { readonly kind: 'module'; readonly module: WebAssembly.Module }
  | { readonly kind: 'question'; readonly id: number; readonly question: Asked };

/** What is answered to each kind of question. */
export interface Answers {
  readonly sort: readonly SortedFile[];
  readonly mesh: MeshReading;
  readonly repairs: OwnBytes;
  readonly mirror: MirroredMesh;
  /** JSON, as the core gives it. */
  readonly suggest: string;
  /** JSON, as the core gives it. */
  readonly plane: string;
  /** `null` where there is no such demo. */
  readonly demo: DemoFiles | null;
}

/** From a worker: what became of the question of the same number, and how much memory its module has in bytes. */
export type ReaderAnswer = { readonly id: number; readonly memory: number } & (
  | { readonly kind: 'answer'; readonly answer: Answers[keyof Answers] }
  | { readonly kind: 'refused'; readonly refusal: Refusal }
  /** The worker is not to be asked again. */
  | { readonly kind: 'failed'; readonly failure: Failure }
);
