/** Does parts of the method again in a worker, to be watched. */
import type { Failure } from './messages.ts';
import { failureOf } from './messages.ts';
import type { Watchable, Watched, WatchMessage, WatchRequest } from './watch-messages.ts';

/** What is told meanwhile and at the end. */
export interface WatchListener<W extends Watchable> {
  readonly progress: (share: number) => void;
  readonly done: (answer: Watched[W]) => void;
  readonly failed: (failure: Failure) => void;
}

/** Starts it; the returned function ends it at once, and the listener hears nothing more. */
export function startWatched<W extends Watchable>(request: WatchRequest & { readonly wanted: W }, listener: WatchListener<W>): () => void {
  const worker = new Worker(new URL('./watch-worker.ts', import.meta.url), { type: 'module' });
  let over = false;
  const end = (): boolean => {
    const first = !over;
    over = true;
    worker.terminate();
    return first;
  };
  const fail = (failure: Failure): void => {
    if (end()) {
      listener.failed(failure);
    }
  };
  worker.addEventListener('message', ({ data }: MessageEvent<WatchMessage>) => {
    if (over) {
      return;
    }
    switch (data.kind) {
      case 'progress':
        listener.progress(data.share);
        break;
      case 'done':
        end();
        // The worker answers what it was asked.
        listener.done(data.answer as Watched[W]);
        break;
      case 'failed':
        fail(data.failure);
        break;
    }
  });
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail({ code: 'worker', message: event.message });
  });
  worker.addEventListener('messageerror', () => {
    fail({ code: 'worker', message: 'an unreadable message' });
  });
  try {
    worker.postMessage(request);
  } catch (thrown) {
    queueMicrotask(() => {
      fail(failureOf(thrown));
    });
  }
  return () => {
    end();
  };
}
