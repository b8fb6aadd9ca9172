/** Runs the flows of both meshes in a worker. */
import type { FlowMessage, FlowRequest, Flows } from './flow-messages.ts';
import type { Failure } from './messages.ts';
import { failureOf } from './messages.ts';

/** What is told while the flows run and when they end. */
export interface FlowListener {
  progress(share: number): void;
  done(flows: Flows): void;
  failed(failure: Failure): void;
}

/** Starts both flows; the returned function ends them at once, and the listener hears nothing more. */
export function startFlows(request: FlowRequest, listener: FlowListener): () => void {
  const worker = new Worker(new URL('./flow-worker.ts', import.meta.url), { type: 'module' });
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
  worker.addEventListener('message', ({ data }: MessageEvent<FlowMessage>) => {
    if (over) {
      return;
    }
    switch (data.kind) {
      case 'progress':
        listener.progress(data.share);
        break;
      case 'done':
        end();
        listener.done(data.flows);
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
