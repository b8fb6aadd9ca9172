/** Has a worker look at files and bring them across, and ends it. */
import type { With } from '../compute/core.ts';
import type { Failure } from '../compute/messages.ts';
import { askOnce } from '../compute/one-request.ts';
import type { Answers, BringFailure, BringMessage, BringRequest } from './messages.ts';

/** What is reported while the worker goes on and at its end. */
export interface BringListener<A> {
  readonly progress: (share: number) => void;
  readonly done: (answer: A) => void;
  readonly failed: (failure: BringFailure) => void;
}

/** The failure with the file at fault; a worker that broke off names none. */
function withFile(failure: Failure): BringFailure {
  return 'file' in failure ? (failure as BringFailure) : { ...failure, file: null };
}

function ask<A extends Answers[keyof Answers]>(request: With<BringRequest>, listener: BringListener<A>): () => void {
  const worker = new Worker(new URL('./bring-worker.ts', import.meta.url), { type: 'module' });
  return askOnce<BringMessage>(worker, request, {
    heard: (message) => {
      if (message.kind === 'progress') {
        listener.progress(message.share);
      } else {
        // The worker's answer is always of the type that its request asks for.
        listener.done(message.answer as A);
      }
    },
    failed: (failure) => {
      listener.failed(withFile(failure));
    },
  });
}

type Request<K extends BringRequest['kind']> = Omit<With<Extract<BringRequest, { readonly kind: K }>>, 'kind'>;

/** Has a worker report what each file may hold; the returned function ends it at once, and the listener hears nothing more. */
export function lookAt(request: Request<'look'>, listener: BringListener<Answers['look']>): () => void {
  return ask({ ...request, kind: 'look' }, listener);
}

/** Has a worker bring files across, in the same way. */
export function bringAcross(request: Request<'bring'>, listener: BringListener<Answers['bring']>): () => void {
  const asked: With<BringRequest> & { readonly kind: 'bring' } = { ...request, kind: 'bring' };
  return ask(asked, listener);
}
