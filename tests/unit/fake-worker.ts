/** Workers that only listen, and send what a test tells them to. */

/** Such a worker, whose messages are of the type M. */
export interface FakeWorker<M> extends EventTarget {
  /** The messages that were posted to it. */
  readonly posted: unknown[];
  ended: boolean;
  says(data: M): void;
}

interface FakeWorkers<M> {
  /** All workers that were made, the latest last. */
  made: FakeWorker<M>[];
  new (): FakeWorker<M>;
}

/** A class of such workers, to replace the browser's. */
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
