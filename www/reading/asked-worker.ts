/** A worker that answers questions. One that breaks off is replaced, and only the question that broke it is lost. */
import type { Failure } from '../compute/messages.ts';
import { failureOf } from '../compute/messages.ts';
import { failureSentence } from '../messages.ts';
import { FileRefused } from '../named-file.ts';
import type { Answers, Question, ReaderAnswer, ReaderRequest } from './messages.ts';

/** The error of a worker that broke off, perhaps because memory ran out. */
export class ReaderBroken extends FileRefused {
  override readonly failure: Failure;

  constructor(failure: Failure) {
    super(failureSentence(failure));
    this.failure = failure;
  }
}

/** The most memory of an idle worker, in bytes: a worker with more is ended, since the memory of its module never shrinks. */
const LARGEST_IDLE = 2 ** 28;

interface Asked<Q extends Question> {
  readonly question: Q;
  readonly resolve: (answer: Answers[keyof Answers]) => void;
  readonly reject: (reason: Error) => void;
}

/** A worker of the reader for questions of the type Q. */
export class AskedWorker<Q extends Question> {
  readonly #make: () => Worker;
  #worker: Worker | null = null;
  /** A function that gives the worker's module. */
  #source: (() => Promise<WebAssembly.Module>) | null = null;
  /** The open questions, in the order in which they were asked. */
  readonly #asked = new Map<number, Asked<Q>>();
  #next = 0;

  constructor(make: () => Worker) {
    this.#make = make;
  }

  /** Takes the function that gives the module whenever a worker is begun; questions may be asked before. */
  use(source: () => Promise<WebAssembly.Module>): void {
    this.#source = source;
    this.#equip();
  }

  /** Begins a worker where there is none, so that it is ready before the first question. */
  begin(): void {
    if (this.#worker === null) {
      this.#worker = this.#made();
      this.#equip();
    }
  }

  /** Asks a question, and returns its answer. */
  ask(question: Q, signal: AbortSignal | null): Promise<Answers[Q['kind']]> {
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      if (signal?.aborted === true) {
        reject(new Error('left'));
        return;
      }
      this.begin();
      this.#asked.set(id, { question, resolve, reject } as Asked<Q>);
      signal?.addEventListener('abort', () => {
        if (this.#asked.delete(id)) {
          reject(new Error('left'));
          // A worker that reads receives no messages, so it is ended.
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

  #post(request: ReaderRequest<Q>): void {
    this.#worker?.postMessage(request);
  }

  #made(): Worker {
    const worker = this.#make();
    worker.addEventListener('message', ({ data }: MessageEvent<ReaderAnswer>) => {
      if (worker === this.#worker) {
        this.#take(data);
      }
    });
    const broken = (message: string): void => {
      if (worker === this.#worker) {
        // The error does not name its question. Questions are answered in their order, so it is the first one.
        const [id] = this.#asked.keys();
        this.#fail(id, { code: 'worker', message });
      }
    };
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      if ('message' in event) {
        broken(event.message);
      } else if (worker === this.#worker) {
        // The worker's script was not loaded, so nothing is wrong with the question.
        this.#giveUp({ code: 'no-core', message: 'the script of a worker' });
      }
    });
    worker.addEventListener('messageerror', () => {
      broken('an unreadable message');
    });
    return worker;
  }

  /** Sends the worker its module as soon as that is loaded. */
  #equip(): void {
    const worker = this.#worker;
    if (worker === null || this.#source === null) {
      return;
    }
    this.#source().then(
      (module) => {
        if (worker === this.#worker) {
          this.#post({ kind: 'module', module });
        }
      },
      (thrown: unknown) => {
        if (worker === this.#worker) {
          this.#giveUp({ code: 'no-core', message: failureOf(thrown).message });
        }
      },
    );
  }

  /** Ends the worker. A fresh one goes on with the open questions; without any, none is begun until the next question. */
  #renew(): void {
    this.#worker?.terminate();
    this.#worker = null;
    if (this.#asked.size > 0) {
      this.begin();
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

  /** Refuses the question that broke the worker, and replaces the worker. */
  #fail(id: number | undefined, failure: Failure): void {
    const asked = id === undefined ? undefined : this.#asked.get(id);
    if (id !== undefined) {
      this.#asked.delete(id);
    }
    this.#renew();
    asked?.reject(new ReaderBroken(failure));
  }

  /** Refuses all open questions, since there is no module; the next question has it fetched again. */
  #giveUp(failure: Failure): void {
    const asked = [...this.#asked.values()];
    this.#asked.clear();
    this.#renew();
    for (const { reject } of asked) {
      reject(new ReaderBroken(failure));
    }
  }
}
