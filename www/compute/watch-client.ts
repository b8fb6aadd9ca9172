/** Computes parts of the method again in a worker, for the user to watch. */
import type { With } from './core.ts';
import type { Failure } from './messages.ts';
import { askOnce } from './one-request.ts';
import type { Watchable, Watched, WatchMessage, WatchRequest } from './watch-messages.ts';

/** What is reported while the worker goes on and at its end. */
export interface WatchListener<W extends Watchable> {
  readonly progress: (share: number) => void;
  readonly done: (answer: Watched[W]) => void;
  readonly failed: (failure: Failure) => void;
}

/** Starts the worker; the returned function ends it at once, and the listener hears nothing more. */
export function startWatched<W extends Watchable>(request: With<WatchRequest> & { readonly wanted: W }, listener: WatchListener<W>): () => void {
  const worker = new Worker(new URL('./watch-worker.ts', import.meta.url), { type: 'module' });
  return askOnce<WatchMessage>(worker, request, {
    heard: (message) => {
      if (message.kind === 'progress') {
        listener.progress(message.share);
      } else {
        // The worker's answer is always of the type that its request asks for.
        listener.done(message.answer as Watched[W]);
      }
    },
    failed: listener.failed,
  });
}
