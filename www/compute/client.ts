/** Starts runs of the pipeline in a worker, and ends them. */
import type { Finding } from '../report.ts';
import type { Failure, Progress, RunOutput, RunRequest, WarmUpRequest, WorkerMessage } from './messages.ts';
import type { With } from './core.ts';
import { postWithCore } from './core.ts';
import { askOnce } from './one-request.ts';

/**
 * Lets the browser optimise the core while the user is still choosing, so that the first run is as fast as later ones;
 * the returned function ends that at once. Nothing depends on it.
 */
export function warmUp(request: With<WarmUpRequest>): () => void {
  const worker = new Worker(new URL('./warmer.ts', import.meta.url), { type: 'module' });
  worker.addEventListener('error', (event) => {
    event.preventDefault();
  });
  // A core that does not load is reported to whoever waits for it, not here.
  postWithCore(worker, request, () => undefined);
  return () => {
    worker.terminate();
  };
}

/** What a run reports while it goes and when it ends. */
export interface RunListener {
  progress(progress: Progress): void;
  /** A map begins to be relaxed, or goes on to a finer level: its energies cannot be compared with those before. */
  relaxes(): void;
  /** A preview of the map that is being made: for each vertex of the source its place on the target. */
  preview(places: Float32Array): void;
  /** From now on the run can be asked to finish. */
  finishable(): void;
  /** Landmark pairs that do not fit, before the map is made. */
  found(findings: readonly Finding[]): void;
  done(output: RunOutput): void;
  failed(failure: Failure): void;
}

/** A run under way. */
export interface Run {
  /** Ends the worker at once; the listener hears nothing more. */
  cancel(): void;
  /** Asks for the result: a whole map, only less relaxed. */
  finish(): void;
}

/** Starts a run. */
export function startRun(request: Omit<With<RunRequest>, 'finishUrl'>, listener: RunListener): Run {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
  const finishUrl = URL.createObjectURL(new Blob());
  const finish = (): void => {
    URL.revokeObjectURL(finishUrl);
  };
  const asked: With<RunRequest> = { ...request, finishUrl };
  const cancel = askOnce<WorkerMessage>(worker, asked, {
    heard: (message) => {
      tell(listener, message);
    },
    failed: (failure) => {
      listener.failed(failure);
    },
    ended: finish,
  });
  return { cancel, finish };
}

function tell(listener: RunListener, message: Exclude<WorkerMessage, { readonly kind: 'failed' }>): void {
  switch (message.kind) {
    case 'progress':
      listener.progress(message);
      break;
    case 'relaxes':
      listener.relaxes();
      break;
    case 'preview':
      listener.preview(message.places);
      break;
    case 'finishable':
      listener.finishable();
      break;
    case 'found':
      listener.found(message.findings);
      break;
    case 'done':
      listener.done(message.output);
      break;
  }
}
