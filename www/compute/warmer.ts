/** Makes a small map and throws it away: the browser optimises code that has run, for all workers with the same module. */
import init, { buildDemo, runMap } from '../wasm/conemap.js';

declare const self: DedicatedWorkerGlobalScope;

const SMALL = 'sphere-tetrahedron';

async function warm(module: WebAssembly.Module): Promise<void> {
  await init({ module_or_path: module });
  const demo = buildDemo(SMALL);
  if (demo !== undefined) {
    const landmarks = new TextDecoder().decode(demo.landmarks());
    const nothing = (): void => undefined;
    const listener = { relaxes: nothing, progress: nothing, found: nothing, wantsResult: () => false };
    runMap(demo.source(), demo.target(), landmarks, '{}', listener);
  }
}

self.addEventListener('message', (event: MessageEvent<WebAssembly.Module>) => {
  void warm(event.data).finally(() => {
    self.close();
  });
});
