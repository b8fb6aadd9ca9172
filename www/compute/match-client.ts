/** Starts searches for landmarks in a worker and ends them. */
import type { With } from './core.ts';
import type { AnswerPicture, FoundPairs, MatchMessage, MatchRequest } from './match-messages.ts';
import type { Failure } from './messages.ts';
import { askOnce } from './one-request.ts';

/** What a search reports while it goes and when it ends. */
export interface MatchListener {
  progress(share: number): void;
  /** The coarse map of the best pairs so far: for each vertex of the source its place on the target; and those pairs that were found. */
  preview(places: Float32Array, pairs: FoundPairs): void;
  /** The report as JSON, and a picture of each of its candidates. */
  done(report: string, pictures: readonly AnswerPicture[]): void;
  failed(failure: Failure): void;
}

/** Starts a search; the returned function ends it at once, and the listener hears nothing more. */
export function startMatch(request: With<MatchRequest>, listener: MatchListener): () => void {
  const worker = new Worker(new URL('./match-worker.ts', import.meta.url), { type: 'module' });
  return askOnce<MatchMessage>(worker, request, {
    heard: (message) => {
      switch (message.kind) {
        case 'progress':
          listener.progress(message.share);
          break;
        case 'preview':
          listener.preview(message.places, message.pairs);
          break;
        case 'done':
          listener.done(message.report, message.pictures);
          break;
      }
    },
    failed: (failure) => {
      listener.failed(failure);
    },
  });
}
