/** The worker of a search for landmarks: it answers one request, then is ended. */
import init, { matchLandmarks } from '../wasm/core.js';
import type { MatchReport } from '../report.ts';
import type { FoundLandmarks } from '../wasm/core.js';
import type { AnswerPicture, FoundPairs, MatchMessage, MatchRequest } from './match-messages.ts';
import { failureOf } from './messages.ts';
import { progressListener } from './progress-listener.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(message: MatchMessage, handedOver: Transferable[] = []): void {
  self.postMessage(message, handedOver);
}

function pictureOf(found: FoundLandmarks, candidate: number): AnswerPicture {
  return { triangles: found.triangles(candidate), places: [found.places(candidate, 0), found.places(candidate, 1)] };
}

function tell(found: FoundLandmarks): void {
  const report = found.report();
  const { candidates } = JSON.parse(report) as MatchReport;
  const pictures = candidates.map((_, candidate) => pictureOf(found, candidate));
  const buffers = pictures.flatMap(({ triangles, places }) => [triangles, ...places].map(({ buffer }) => buffer as ArrayBuffer));
  post({ kind: 'done', report, pictures }, buffers);
}

/** The pairs of vertices, the source's and the target's in turn. */
function pairsOf(vertices: Uint32Array): FoundPairs {
  return Array.from({ length: vertices.length / 2 }, (_, k) => [vertices[2 * k] ?? 0, vertices[2 * k + 1] ?? 0]);
}

async function search({ module, source, target, landmarks }: MatchRequest): Promise<void> {
  try {
    await init({ module_or_path: module });
    const listener = progressListener(
      (share) => {
        post({ kind: 'progress', share });
      },
      (places, vertices) => {
        const own = places as Float32Array<ArrayBuffer>;
        post({ kind: 'preview', places: own, pairs: pairsOf(vertices) }, [own.buffer]);
      },
    );
    tell(matchLandmarks(source, target, landmarks, listener));
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<MatchRequest>) => {
  void search(event.data);
});
