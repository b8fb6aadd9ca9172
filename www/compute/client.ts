/** Starts runs in a worker and ends them. The module is compiled once and shared. */
import { failureOf } from './messages.ts';
import type { Finding } from '../report.ts';
import type { Failure, Progress, RunOutput, RunRequest, WorkerMessage } from './messages.ts';

/** Compiles the core; the same module serves the page and every worker. */
export async function compileCore(): Promise<WebAssembly.Module> {
  const url = new URL('../wasm/conemap_bg.wasm', import.meta.url);
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`the program's core could not be fetched (status ${response.status})`);
  }
  if (response.headers.get('content-type') === 'application/wasm') {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** What a run reports while it goes and when it ends. */
export interface RunListener {
  progress(progress: Progress): void;
  /** Landmark pairs that do not fit, before the map is made. */
  found(findings: readonly Finding[]): void;
  done(output: RunOutput): void;
  failed(failure: Failure): void;
}

/** A run under way. */
export interface Run {
  /** Ends the worker at once; the listener hears nothing more. */
  cancel(): void;
}

/** Starts a run. */
export function startRun(request: RunRequest, listener: RunListener): Run {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  let over = false;
  const end = (): boolean => {
    const first = !over;
    over = true;
    worker.terminate();
    return first;
  };
  worker.addEventListener('message', (event: MessageEvent<WorkerMessage>) => {
    const message = event.data;
    if (over) {
      return;
    }
    switch (message.kind) {
      case 'progress':
        listener.progress(message);
        break;
      case 'found':
        listener.found(message.findings);
        break;
      case 'done':
        end();
        listener.done(message.output);
        break;
      case 'failed':
        end();
        listener.failed(message.failure);
        break;
    }
  });
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    if (end()) {
      listener.failed({ code: 'worker', message: event.message });
    }
  });
  worker.addEventListener('messageerror', () => {
    if (end()) {
      listener.failed({ code: 'worker', message: 'an unreadable message' });
    }
  });
  try {
    worker.postMessage(request);
  } catch (thrown) {
    end();
    queueMicrotask(() => {
      listener.failed(failureOf(thrown));
    });
  }
  return {
    cancel: () => {
      end();
    },
  };
}
