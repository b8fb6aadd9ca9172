/** Starts searches for landmarks in a worker and ends them. */
import type { MatchMessage, MatchRequest } from './match-messages.ts';
import type { Failure } from './messages.ts';
import { failureOf } from './messages.ts';

/** What a search reports while it goes and when it ends. */
export interface MatchListener {
  progress(share: number): void;
  /** The report is JSON. */
  done(report: string): void;
  failed(failure: Failure): void;
}

/** Starts a search; the returned function ends it at once, and the listener hears nothing more. */
export function startMatch(request: MatchRequest, listener: MatchListener): () => void {
  const worker = new Worker(new URL('./match-worker.ts', import.meta.url), { type: 'module' });
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
  worker.addEventListener('message', ({ data }: MessageEvent<MatchMessage>) => {
    if (over) {
      return;
    }
    switch (data.kind) {
      case 'progress':
        listener.progress(data.share);
        break;
      case 'done':
        end();
        listener.done(data.report);
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
  return end;
}
