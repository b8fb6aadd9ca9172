/** Does parts of the method again in a worker, to be looked at. */
import type { With } from './core.ts';
import type { Failure } from './messages.ts';
import { askOnce } from './one-request.ts';
import type { Watchable, Watched, WatchMessage, WatchRequest } from './watch-messages.ts';

/** What is told meanwhile and at the end. */
export interface WatchListener<W extends Watchable> {
  readonly progress: (share: number) => void;
  readonly done: (answer: Watched[W]) => void;
  readonly failed: (failure: Failure) => void;
}

/** Starts it; the returned function ends it at once, and the listener hears nothing more. */
export function startWatched<W extends Watchable>(request: With<WatchRequest> & { readonly wanted: W }, listener: WatchListener<W>): () => void {
  const worker = new Worker(new URL('./watch-worker.ts', import.meta.url), { type: 'module' });
  return askOnce<WatchMessage>(worker, request, {
    heard: (message) => {
      if (message.kind === 'progress') {
        listener.progress(message.share);
      } else {
        // The worker answers what it was asked.
        listener.done(message.answer as Watched[W]);
      }
    },
    failed: listener.failed,
  });
}
