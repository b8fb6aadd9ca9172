/** Workers that only listen, and say what a test tells them to. */

/** One of them, whose messages are of the type M. */
export interface FakeWorker<M> extends EventTarget {
  /** What it was told. */
  readonly posted: unknown[];
  ended: boolean;
  says(data: M): void;
}

interface FakeWorkers<M> {
  /** All that were made, the last one last. */
  made: FakeWorker<M>[];
  new (): FakeWorker<M>;
}

/** A class of workers of their own, to take the place of the browser's. */
export function fakeWorkers<M>(): FakeWorkers<M> {
  return class FakeWorker extends EventTarget {
    static made: FakeWorker[] = [];
    readonly posted: unknown[] = [];
    ended = false;

    constructor() {
      super();
      FakeWorker.made.push(this);
    }

    postMessage(message: unknown): void {
      this.posted.push(message);
    }

    terminate(): void {
      this.ended = true;
    }

    says(data: M): void {
      this.dispatchEvent(new MessageEvent('message', { data }));
    }
  };
}
