/** The worker that makes a small map and throws it away: the browser optimises code that has run, for all workers with the same module. */
import init, { buildDemo, runMap } from '../wasm/core.js';
import type { WarmUpRequest } from './messages.ts';
import { progressListener } from './progress-listener.ts';

declare const self: DedicatedWorkerGlobalScope;

async function warm(request: WarmUpRequest): Promise<void> {
  await init({ module_or_path: request.module });
  const demo = buildDemo(request.demo);
  if (demo !== undefined) {
    const landmarks = new TextDecoder().decode(demo.landmarks());
    runMap(demo.source(), demo.target(), landmarks, '{}', progressListener(() => undefined));
  }
}

self.addEventListener('message', (event: MessageEvent<WarmUpRequest>) => {
  void warm(event.data).finally(() => {
    self.close();
  });
});
