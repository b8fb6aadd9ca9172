/** A saved map: opens it once, then gives what the views show and its files. Nothing is computed. */
import init, { openMap } from '../wasm/conemap.js';
import type { SavedMap } from '../wasm/conemap.js';
import { failureOf } from './messages.ts';
import type { SavedAnswer, SavedFailure, SavedRequest } from './saved-messages.ts';
import { openedOf, transferable } from './view-buffers.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(answer: SavedAnswer, transfer: Transferable[] = []): void {
  self.postMessage(answer, transfer);
}

/** The mesh that a failure of the core names. */
function sideOf(thrown: unknown): SavedFailure['side'] {
  try {
    const value: unknown = typeof thrown === 'string' ? JSON.parse(thrown) : null;
    const side = typeof value === 'object' && value !== null && 'side' in value ? value.side : null;
    return side === 'source' || side === 'target' ? side : null;
  } catch {
    return null;
  }
}

let open: Promise<SavedMap> | null = null;

async function start(request: Extract<SavedRequest, { kind: 'open' }>): Promise<SavedMap> {
  await init({ module_or_path: request.module });
  return openMap(request.map, request.source, request.target);
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
    const map = await open;
    switch (request.kind) {
      case 'open': {
        const opened = request.show === 'views' ? openedOf(map) : null;
        post({ kind: 'opened', id, opened }, opened === null ? [] : transferable(opened.buffers, [opened.landmarks]));
        break;
      }
      case 'file': {
        const bytes = map.file(request.name).slice();
        post({ kind: 'file', id, bytes }, [bytes.buffer]);
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
