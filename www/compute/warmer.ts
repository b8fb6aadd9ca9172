/** Makes a small map and throws it away: the browser optimises code that has run, for all workers with the same module. */
import init, { buildDemo, runMap } from '../wasm/core.js';
import type { WarmUpRequest } from './messages.ts';

declare const self: DedicatedWorkerGlobalScope;

async function warm(request: WarmUpRequest): Promise<void> {
  await init({ module_or_path: request.module });
  const demo = buildDemo(request.demo);
  if (demo !== undefined) {
    const landmarks = new TextDecoder().decode(demo.landmarks());
    const nothing = (): void => undefined;
    const listener = { relaxes: nothing, progress: nothing, preview: nothing, found: nothing, wantsResult: () => false };
    runMap(demo.source(), demo.target(), landmarks, '{}', listener);
  }
}

self.addEventListener('message', (event: MessageEvent<WarmUpRequest>) => {
  void warm(event.data).finally(() => {
    self.close();
  });
});
