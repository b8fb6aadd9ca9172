/** A worker that is asked once, tells how it goes on, and is thrown away with its last message. */
import type { Core } from './core.ts';
import { postWithCore } from './core.ts';
import type { Failure } from './messages.ts';

/** What such a worker says: `done` and `failed` are last. */
type Message = { readonly kind: string } | { readonly kind: 'failed'; readonly failure: Failure };

/** Who hears it. */
interface Listener<M extends Message> {
  /** A message that is no failure; after `done` the worker has ended. */
  heard(message: Exclude<M, { readonly kind: 'failed' }>): void;
  failed(failure: Failure): void;
  /** The worker has ended, for whatever reason; the first thing that is heard of it. */
  ended?(): void;
}

function isFailed<M extends Message>(message: M): message is Extract<M, { readonly kind: 'failed' }> {
  return message.kind === 'failed';
}

/** Asks a worker; the returned function ends it at once, and the listener hears nothing more. */
export function askOnce<M extends Message>(worker: Worker, request: { readonly module: Core }, listener: Listener<M>): () => void {
  let over = false;
  const end = (): boolean => {
    const first = !over;
    over = true;
    worker.terminate();
    if (first) {
      listener.ended?.();
    }
    return first;
  };
  const fail = (failure: Failure): void => {
    if (end()) {
      listener.failed(failure);
    }
  };
  worker.addEventListener('message', ({ data }: MessageEvent<M>) => {
    if (over) {
      return;
    }
    if (isFailed(data)) {
      fail((data as { readonly failure: Failure }).failure);
      return;
    }
    if (data.kind === 'done') {
      end();
    }
    listener.heard(data as Exclude<M, { readonly kind: 'failed' }>);
  });
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    fail({ code: 'worker', message: event.message });
  });
  worker.addEventListener('messageerror', () => {
    fail({ code: 'worker', message: 'an unreadable message' });
  });
  postWithCore(worker, request, fail);
  return () => {
    end();
  };
}
