/** Starts searches for landmarks in a worker and ends them. */
import type { With } from './core.ts';
import type { AnswerPicture, MatchMessage, MatchRequest } from './match-messages.ts';
import type { Failure } from './messages.ts';
import { askOnce } from './one-request.ts';

/** What a search reports while it goes and when it ends. */
export interface MatchListener {
  progress(share: number): void;
  /** The report as JSON, and a picture of each of its candidates. */
  done(report: string, pictures: readonly AnswerPicture[]): void;
  failed(failure: Failure): void;
}

/** Starts a search; the returned function ends it at once, and the listener hears nothing more. */
export function startMatch(request: With<MatchRequest>, listener: MatchListener): () => void {
  const worker = new Worker(new URL('./match-worker.ts', import.meta.url), { type: 'module' });
  return askOnce<MatchMessage>(worker, request, {
    heard: (message) => {
      if (message.kind === 'progress') {
        listener.progress(message.share);
      } else {
        listener.done(message.report, message.pictures);
      }
    },
    failed: (failure) => {
      listener.failed(failure);
    },
  });
}
