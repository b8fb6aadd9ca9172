/** A worker that answers questions; one that breaks off is replaced, and nothing else is lost. */
import type { Failure } from '../compute/messages.ts';
import { failureOf } from '../compute/messages.ts';
import { failureSentence } from '../messages.ts';
import { FileRefused } from '../named-file.ts';
import type { Answers, Question, ReaderAnswer, ReaderRequest } from './messages.ts';

/** The worker broke off, perhaps for want of memory. */
export class ReaderBroken extends FileRefused {
  override readonly failure: Failure;

  constructor(failure: Failure) {
    super(failureSentence(failure));
    this.failure = failure;
  }
}

/** In bytes: with more than this a worker that has nothing to do is let go, since memory of its module never shrinks. */
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
  /** What gives its module. */
  #source: (() => Promise<WebAssembly.Module>) | null = null;
  /** In the order in which they were asked. */
  readonly #asked = new Map<number, Asked<Q>>();
  #next = 0;

  constructor(make: () => Worker) {
    this.#make = make;
  }

  /** Where the module comes from whenever a worker is begun; questions may be asked before. */
  use(source: () => Promise<WebAssembly.Module>): void {
    this.#source = source;
    this.#equip();
  }

  /** Begins a worker where there is none, also before anybody asks. */
  begin(): void {
    if (this.#worker === null) {
      this.#worker = this.#made();
      this.#equip();
    }
  }

  /** A question's answer. */
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
        // Which question it was cannot be told: it answers them in their order.
        const [id] = this.#asked.keys();
        this.#fail(id, { code: 'worker', message });
      }
    };
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      if ('message' in event) {
        broken(event.message);
      } else if (worker === this.#worker) {
        // Its script did not come: nothing is wrong with what it was asked.
        this.#giveUp({ code: 'no-core', message: 'the script of a worker' });
      }
    });
    worker.addEventListener('messageerror', () => {
      broken('an unreadable message');
    });
    return worker;
  }

  /** The worker gets its module as soon as that is there. */
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

  /** A fresh worker goes on with what is not answered; without anything, none does until somebody asks. */
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

  /** A question broke the worker. */
  #fail(id: number | undefined, failure: Failure): void {
    const asked = id === undefined ? undefined : this.#asked.get(id);
    if (id !== undefined) {
      this.#asked.delete(id);
    }
    this.#renew();
    asked?.reject(new ReaderBroken(failure));
  }

  /** There is no module: nothing can be answered, and the next question has it fetched again. */
  #giveUp(failure: Failure): void {
    const asked = [...this.#asked.values()];
    this.#asked.clear();
    this.#renew();
    for (const { reject } of asked) {
      reject(new ReaderBroken(failure));
    }
  }
}
