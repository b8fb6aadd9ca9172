/** Reads files in a worker, so that the page answers meanwhile; one that breaks off is replaced, and nothing else is lost. */
import type { Failure } from '../compute/messages.ts';
import { failureOf } from '../compute/messages.ts';
import { failureSentence, fileSentence } from '../messages.ts';
import type { NamedBytes } from '../named-file.ts';
import { FileRefused } from '../named-file.ts';
import type { Allowed } from '../store/refused.ts';
import type { Answers, MeshReading, Question, ReaderAnswer, ReaderRequest } from './messages.ts';

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

/** The worker broke off, perhaps for want of memory. */
export class ReaderBroken extends FileRefused {
  override readonly failure: Failure;

  constructor(failure: Failure) {
    super(failureSentence(failure));
    this.failure = failure;
  }
}

/** In bytes: with more than this a worker that has nothing to do is let go, since memory of the core never shrinks. */
const LARGEST_IDLE = 2 ** 28;

interface Asked {
  readonly question: Question;
  readonly resolve: (answer: Answers[keyof Answers]) => void;
  readonly reject: (reason: Error) => void;
}

/** The page's reader. */
export class Reader implements FileReader {
  #worker: Worker | null = null;
  #core: WebAssembly.Module | null = null;
  /** In the order in which they were asked. */
  readonly #asked = new Map<number, Asked>();
  #next = 0;
  /** A demo that was begun before anybody asked for it. */
  #foreseen: { readonly id: string; readonly answer: Promise<Answers['demo']>; readonly end: AbortController } | null = null;

  constructor() {
    this.#begin();
  }

  /** The core has come; questions may be asked before. */
  use(core: WebAssembly.Module): void {
    this.#core = core;
    this.#post({ kind: 'core', module: core });
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
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      if (signal?.aborted === true) {
        reject(new Error('left'));
        return;
      }
      if (this.#worker === null) {
        this.#begin();
      }
      this.#asked.set(id, { question, resolve, reject });
      signal?.addEventListener('abort', () => {
        if (this.#asked.delete(id)) {
          reject(new Error('left'));
          // A worker that reads hears nothing.
          this.#renew();
        }
      });
      try {
        this.#post({ kind: 'question', id, question });
      } catch (thrown) {
        this.#asked.delete(id);
        reject(new ReaderBroken(failureOf(thrown)));
      }
    });
  }

  #post(request: ReaderRequest): void {
    this.#worker?.postMessage(request);
  }

  #begin(): void {
    const worker = new Worker(new URL('./reader-worker.ts', import.meta.url), { type: 'module' });
    this.#worker = worker;
    worker.addEventListener('message', ({ data }: MessageEvent<ReaderAnswer>) => {
      if (worker === this.#worker) {
        this.#take(data);
      }
    });
    const broken = (message: string): void => {
      if (worker === this.#worker) {
        // Which question it was cannot be told: it answers them in their order.
        const [id] = this.#asked.keys();
        this.#fail(id, { code: 'worker', message });
      }
    };
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      broken(event.message);
    });
    worker.addEventListener('messageerror', () => {
      broken('an unreadable message');
    });
    if (this.#core !== null) {
      this.#post({ kind: 'core', module: this.#core });
    }
  }

  /** A fresh worker goes on with what is not answered; without anything, none does until somebody asks. */
  #renew(): void {
    this.#worker?.terminate();
    this.#worker = null;
    if (this.#asked.size > 0) {
      this.#begin();
      this.#asked.forEach(({ question }, id) => {
        this.#post({ kind: 'question', id, question });
      });
    }
  }

  #take(data: ReaderAnswer): void {
    const asked = this.#asked.get(data.id);
    switch (data.kind) {
      case 'failed':
        this.#fail(data.id, data.failure);
        return;
      case 'answer':
        this.#asked.delete(data.id);
        asked?.resolve(data.answer);
        break;
      case 'refused':
        this.#asked.delete(data.id);
        asked?.reject(new FileRefused(data.refusal.sentence, data.refusal));
        break;
    }
    if (this.#asked.size === 0 && data.memory > LARGEST_IDLE) {
      this.#renew();
    }
  }

  /** A question broke the worker. */
  #fail(id: number | undefined, failure: Failure): void {
    const asked = id === undefined ? undefined : this.#asked.get(id);
    if (id !== undefined) {
      this.#asked.delete(id);
    }
    this.#renew();
    asked?.reject(new ReaderBroken(failure));
  }
}
