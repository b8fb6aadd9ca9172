/** A worker that is asked once, reports its progress, and is ended after its last message. */
import type { Core } from './core.ts';
import { postWithCore } from './core.ts';
import type { Failure } from './messages.ts';

/** A message of such a worker: `done` and `failed` are the last. */
type Message = { readonly kind: string } | { readonly kind: 'failed'; readonly failure: Failure };

/** The listener to such a worker. */
interface Listener<M extends Message> {
  /** Called with each message that is no failure; after `done` the worker has ended. */
  heard(message: Exclude<M, { readonly kind: 'failed' }>): void;
  failed(failure: Failure): void;
  /** Called once the worker has ended, for whatever reason, and before any other call that follows from its end. */
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
