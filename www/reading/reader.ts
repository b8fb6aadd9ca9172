/**
 * Reads files in two workers, so that the page can be used meanwhile. One has the page's module, for files and demos; the other has the
 * core, for meshes.
 */
import { fileSentence } from '../messages.ts';
import type { NamedBytes } from '../named-file.ts';
import type { Allowed } from '../store/refused.ts';
import { AskedWorker, ReaderBroken } from './asked-worker.ts';
import type { Answers, FileQuestion, MeshQuestion, MeshReading, Question } from './messages.ts';
import { isOfFiles } from './messages.ts';

/** Reads files. Its promises fail with `FileRefused`; after their signal was aborted they fail with any error. */
export interface FileReader {
  /** Asks a question, and returns its answer. */
  ask<Kind extends Question['kind']>(
    question: Extract<Question, { readonly kind: Kind }>,
    signal: AbortSignal | null,
  ): Promise<Answers[Kind]>;
}

/** Reads a mesh file. A failure of the reader counts as a refusal of this file, so that the other files are still opened. */
export async function readMesh(reader: FileReader, file: NamedBytes, allowed: Allowed, signal: AbortSignal): Promise<MeshReading> {
  try {
    return await reader.ask({ kind: 'mesh', file, allowed }, signal);
  } catch (thrown) {
    if (signal.aborted || !(thrown instanceof ReaderBroken)) {
      throw thrown;
    }
    const { failure } = thrown;
    return { kind: 'bad', sentence: fileSentence(file.name, failure), offer: null, what: 'file', defects: null, failure };
  }
}

/** The page's reader. */
export class Reader implements FileReader {
  readonly #files = new AskedWorker<FileQuestion>(() => new Worker(new URL('./file-worker.ts', import.meta.url), { type: 'module' }));
  readonly #meshes = new AskedWorker<MeshQuestion>(() => new Worker(new URL('./mesh-worker.ts', import.meta.url), { type: 'module' }));
  /** The demo whose building was begun before the page asked for it. */
  #foreseen: { readonly id: string; readonly answer: Promise<Answers['demo']>; readonly end: AbortController } | null = null;

  constructor() {
    this.#files.begin();
  }

  /** Takes the page's module, and the function that gives the core, which is called with the first mesh. Questions may be asked before. */
  use(page: WebAssembly.Module, core: () => Promise<WebAssembly.Module>): void {
    this.#files.use(() => Promise.resolve(page));
    this.#meshes.use(core);
  }

  /** Begins to build a demo that will be asked for; any other question ends that. */
  foresee(id: string): void {
    this.#foreseen?.end.abort();
    const end = new AbortController();
    const answer = this.#put({ kind: 'demo', id }, end.signal) as Promise<Answers['demo']>;
    // The failure is reported to whoever asks for the demo.
    answer.catch(() => undefined);
    this.#foreseen = { id, answer, end };
  }

  ask<Kind extends Question['kind']>(
    question: Extract<Question, { readonly kind: Kind }>,
    signal: AbortSignal | null,
  ): Promise<Answers[Kind]> {
    const foreseen = this.#foreseen;
    this.#foreseen = null;
    const asked: Question = question;
    if (foreseen !== null && asked.kind === 'demo' && asked.id === foreseen.id) {
      signal?.addEventListener('abort', () => {
        foreseen.end.abort();
      });
      return foreseen.answer as Promise<Answers[Kind]>;
    }
    foreseen?.end.abort();
    // The worker answers each kind of question as `Answers` says.
    return this.#put(question, signal) as Promise<Answers[Kind]>;
  }

  #put(question: Question, signal: AbortSignal | null): Promise<Answers[keyof Answers]> {
    return isOfFiles(question) ? this.#files.ask(question, signal) : this.#meshes.ask(question, signal);
  }
}
