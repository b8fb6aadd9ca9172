/**
 * The worker of a saved map: it opens the map once, then gives what the views show and the files, lays the source onto the target, and
 * proves the map.
 */
import type { ProofReport } from '../report.ts';
import init, { openMap, proveMap } from '../wasm/core.js';
import type { SavedMap } from '../wasm/core.js';
import { failureField, failureOf } from './messages.ts';
import type { SavedAnswer, SavedFailure, SavedFiles, SavedRequest } from './saved-messages.ts';
import { openedOf, transferable } from './view-buffers.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(answer: SavedAnswer, transfer: Transferable[] = []): void {
  self.postMessage(answer, transfer);
}

/** The mesh that a failure of the core names. */
function sideOf(thrown: unknown): SavedFailure['side'] {
  const side = failureField(thrown, 'side');
  return side === 'source' || side === 'target' ? side : null;
}

interface Open {
  readonly map: SavedMap;
  readonly files: SavedFiles;
}

let open: Promise<Open> | null = null;

async function start(request: Extract<SavedRequest, { kind: 'open' }>): Promise<Open> {
  await init({ module_or_path: request.module });
  const { map, source, target, pictures, demo } = request;
  return { map: openMap(map, source, target), files: { map, source, target, ...(pictures === undefined ? {} : { pictures }), demo: demo ?? null } };
}

async function answer(request: SavedRequest): Promise<void> {
  const { id } = request;
  try {
    if (request.kind === 'open') {
      open = start(request);
    }
    if (open === null) {
      throw new Error('no map is open');
    }
    const { map, files } = await open;
    switch (request.kind) {
      case 'open': {
        const opened = request.show === 'views' ? openedOf(map, files.demo ?? null) : null;
        post({ kind: 'opened', id, opened }, opened === null ? [] : transferable(opened.buffers, [opened.landmarks]));
        break;
      }
      case 'file': {
        if (request.name.endsWith('.glb')) {
          map.takeLook(files.source, files.target, ...(files.pictures ?? []));
        }
        const bytes = map.file(request.name).slice();
        post({ kind: 'file', id, bytes }, [bytes.buffer]);
        break;
      }
      case 'wrap': {
        const wrapped = map.wrapped(files.source);
        const bytes = wrapped.bytes().slice();
        const sentence = wrapped.sentence();
        wrapped.free();
        post({ kind: 'wrapped', id, wrapped: { bytes, sentence } }, [bytes.buffer]);
        break;
      }
      case 'way': {
        const { source, target, triangles, faces } = request.points;
        const made = map.way(source, target, triangles, faces);
        const way = { laid: made.laid(), range: made.range(), bends: made.bends() };
        made.free();
        post({ kind: 'way', id, way }, [way.bends.buffer]);
        break;
      }
      case 'prove': {
        const proof = JSON.parse(proveMap(files.map, files.source, files.target)) as ProofReport;
        post({ kind: 'proved', id, proof });
        break;
      }
    }
  } catch (thrown) {
    post({ kind: 'failed', id, failure: { ...failureOf(thrown), side: sideOf(thrown) } });
  }
}

self.addEventListener('message', (event: MessageEvent<SavedRequest>) => {
  void answer(event.data);
});
