/** Reads files in two workers, so that the page answers meanwhile: one has the page's module, for files and demos, one the core, for meshes. */
import { fileSentence } from '../messages.ts';
import type { NamedBytes } from '../named-file.ts';
import type { Allowed } from '../store/refused.ts';
import { AskedWorker, ReaderBroken } from './asked-worker.ts';
import type { Answers, FileQuestion, MeshQuestion, MeshReading, Question } from './messages.ts';
import { isOfFiles } from './messages.ts';

/** What reads files. Promises fail with `FileRefused`, and with anything once their signal has told to leave it. */
export interface FileReader {
  /** A question's answer. */
  ask<Kind extends Question['kind']>(
    question: Extract<Question, { readonly kind: Kind }>,
    signal: AbortSignal | null,
  ): Promise<Answers[Kind]>;
}

/** What became of a mesh file. A failure of the reader is one of the file, so that others are not given up for it. */
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
  /** A demo that was begun before anybody asked for it. */
  #foreseen: { readonly id: string; readonly answer: Promise<Answers['demo']>; readonly end: AbortController } | null = null;

  constructor() {
    this.#files.begin();
  }

  /** The page's module has come, and `core` gives the other, which is asked for with the first mesh; questions may be asked before. */
  use(page: WebAssembly.Module, core: () => Promise<WebAssembly.Module>): void {
    this.#files.use(() => Promise.resolve(page));
    this.#meshes.use(core);
  }

  /** Begins with a demo that will be asked for; any other question ends it. */
  foresee(id: string): void {
    this.#foreseen?.end.abort();
    const end = new AbortController();
    const answer = this.#put({ kind: 'demo', id }, end.signal) as Promise<Answers['demo']>;
    // Who asks for it hears of a failure.
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
