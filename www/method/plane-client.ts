/** Starts the worker that lays the flat metrics out in the plane; it runs as long as they are looked at. */
import type { With } from '../compute/core.ts';
import { postWithCore } from '../compute/core.ts';
import type { Failure } from '../compute/messages.ts';
import type { PlaneAnswers, PlaneMessage, PlaneQuestions, PlaneRequest } from './plane-messages.ts';

/** Answers questions about both meshes in the plane. */
export interface Planes {
  readonly ask: <K extends keyof PlaneQuestions>(kind: K, question: PlaneQuestions[K]) => Promise<PlaneAnswers[K]>;
}

export interface PlaneListener {
  readonly progress: (share: number) => void;
  readonly done: (planes: Planes) => void;
  readonly failed: (failure: Failure) => void;
}

/** Starts the worker; the returned function ends it, and after that nothing is reported or answered. */
export function startPlanes(request: With<PlaneRequest>, listener: PlaneListener): () => void {
  const worker = new Worker(new URL('./plane-worker.ts', import.meta.url), { type: 'module' });
  const waiting = new Map<number, (answer: PlaneAnswers[keyof PlaneAnswers]) => void>();
  let asked = 0;
  let isOver = false;
  const planes: Planes = {
    ask: <K extends keyof PlaneQuestions>(kind: K, question: PlaneQuestions[K]) =>
      new Promise<PlaneAnswers[K]>((resolve) => {
        asked += 1;
        // The worker's answer is always of the type that its question asks for.
        waiting.set(asked, resolve as (answer: PlaneAnswers[keyof PlaneAnswers]) => void);
        worker.postMessage({ kind, number: asked, question });
      }),
  };
  const end = (): void => {
    isOver = true;
    worker.terminate();
  };
  const fail = (failure: Failure): void => {
    if (!isOver) {
      end();
      listener.failed(failure);
    }
  };
  worker.addEventListener('message', ({ data }: MessageEvent<PlaneMessage>) => {
    if (isOver) {
      return;
    }
    switch (data.kind) {
      case 'progress':
        listener.progress(data.share);
        break;
      case 'ready':
        listener.done(planes);
        break;
      case 'answer':
        waiting.get(data.number)?.(data.answer);
        waiting.delete(data.number);
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
  postWithCore(worker, request, fail);
  return end;
}
