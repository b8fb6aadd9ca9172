/** One search for landmarks: answers one request, then is thrown away. */
import init, { matchLandmarks } from '../wasm/core.js';
import type { MatchMessage, MatchRequest } from './match-messages.ts';
import { failureOf } from './messages.ts';
import { progressListener } from './progress-listener.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(message: MatchMessage): void {
  self.postMessage(message);
}

async function search({ module, source, target, landmarks }: MatchRequest): Promise<void> {
  try {
    await init({ module_or_path: module });
    const listener = progressListener((share) => {
      post({ kind: 'progress', share });
    });
    const report = matchLandmarks(source, target, landmarks, listener);
    post({ kind: 'done', report });
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<MatchRequest>) => {
  void search(event.data);
});
