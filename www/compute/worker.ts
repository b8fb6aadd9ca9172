/** The worker of one run of the pipeline: it answers one request, then is ended. */
import init, { runMap } from '../wasm/core.js';
import type { MapOutput } from '../wasm/core.js';
import type { Finding } from '../report.ts';
import { failureOf } from './messages.ts';
import type { RunOutput, RunRequest, WorkerMessage } from './messages.ts';
import { transferable, viewBuffers } from './view-buffers.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(message: WorkerMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

function read(output: MapOutput, { source, target, pictures }: RunRequest): RunOutput {
  const map = output.mapFile()?.slice() ?? null;
  // Files that can be made from the map file later are not made now.
  const made = map === null ? { glb: output.glb(source, target, ...pictures).slice(), csv: output.csv().slice(), baseObj: output.baseObj().slice() } : null;
  return { ...viewBuffers(output), map, made };
}

function buffersOf(output: RunOutput): Transferable[] {
  const { map, made } = output;
  const files = made === null ? [] : [made.glb, made.csv, made.baseObj];
  return transferable(output, map === null ? files : [...files, map]);
}

function finite(value: number): number | null {
  return Number.isFinite(value) ? value : null;
}

/**
 * Whether the page has revoked the address of an empty file. A worker that computes receives no message, but it can ask for a file and wait
 * for the answer.
 */
function isRevoked(url: string): boolean {
  const request = new XMLHttpRequest();
  request.open('GET', url, false);
  try {
    request.send();
  } catch {
    return true;
  }
  return request.status !== 200;
}

async function run(request: RunRequest): Promise<void> {
  try {
    await init({ module_or_path: request.module });
    // Where the file cannot be read even now, a later failure to read it would mean nothing.
    const canAsk = !isRevoked(request.finishUrl);
    if (canAsk && request.options.method === 'relaxed') {
      post({ kind: 'finishable' });
    }
    const output = runMap(
      request.source,
      request.target,
      request.landmarks,
      JSON.stringify(request.options),
      {
        progress: (stage, sentence, share, residual, energy) => {
          post({ kind: 'progress', stage, sentence, share, residual: finite(residual), energy: finite(energy) });
        },
        relaxes: () => {
          post({ kind: 'relaxes' });
        },
        preview: (places) => {
          const own = places as Float32Array<ArrayBuffer>;
          post({ kind: 'preview', places: own }, [own.buffer]);
        },
        found: (json) => {
          post({ kind: 'found', findings: JSON.parse(json) as Finding[] });
        },
        wantsResult: () => canAsk && isRevoked(request.finishUrl),
      },
      request.demo,
    );
    const copy = read(output, request);
    output.free();
    post({ kind: 'done', output: copy }, buffersOf(copy));
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<RunRequest>) => {
  void run(event.data);
});
