/** A saved map in a worker of its own: it is opened with its meshes, shown, exported, wrapped and proved. */
import type { ProofReport } from '../report.ts';
import type { Core } from './core.ts';
import { postWithCore } from './core.ts';
import type { OpenedMap, SavedAnswer, SavedFailure, SavedFiles, SavedRequest, Way, WayPoints, WrappedFile } from './saved-messages.ts';

/** The error of a saved map's promises. */
export class SavedMapError extends Error {
  readonly failure: SavedFailure;

  constructor(failure: SavedFailure) {
    super(failure.message);
    this.name = 'SavedMapError';
    this.failure = failure;
  }
}

/** A saved map. Its promises fail with a {@link SavedMapError}. */
export interface SavedMapHandle {
  /** The map for the views; `null` where the map was opened for files alone. */
  readonly opened: Promise<OpenedMap | null>;
  /** One file of the map by its name: `map.conemap`, `source-with-target-texture.glb`, and the others that the command line writes. */
  file(name: string): Promise<Uint8Array<ArrayBuffer>>;
  /** The source's file with its vertices laid onto the target. */
  wrapped(): Promise<WrappedFile>;
  /** How points of the map move from the source's shape to the target's. */
  way(points: WayPoints): Promise<Way>;
  /** The verdict on the map by a second program, which is independent of the one that made it. */
  proof(): Promise<ProofReport>;
  /** Ends the worker; open questions fail with the code `closed`. */
  close(): void;
}

type Body = SavedRequest extends infer R ? (R extends SavedRequest ? Omit<R, 'id' | 'module'> : never) : never;

interface Waiting {
  readonly resolve: (answer: SavedAnswer) => void;
  readonly reject: (error: SavedMapError) => void;
}

/** Opens a map file with its meshes: for the views and files, or for files alone, which is faster. */
export function openSavedMap(module: Core, files: SavedFiles, show: 'views' | 'files'): SavedMapHandle {
  const worker = new Worker(new URL('./saved-worker.ts', import.meta.url), { type: 'module' });
  const waiting = new Map<number, Waiting>();
  let next = 0;
  let ended: SavedFailure | null = null;
  const end = (failure: SavedFailure): void => {
    ended ??= failure;
    worker.terminate();
    const error = new SavedMapError(ended);
    waiting.forEach(({ reject }) => {
      reject(error);
    });
    waiting.clear();
  };
  worker.addEventListener('message', (event: MessageEvent<SavedAnswer>) => {
    const answer = event.data;
    const asked = waiting.get(answer.id);
    waiting.delete(answer.id);
    if (answer.kind === 'failed') {
      asked?.reject(new SavedMapError(answer.failure));
    } else {
      asked?.resolve(answer);
    }
  });
  worker.addEventListener('error', (event) => {
    event.preventDefault();
    end({ code: 'worker', message: event.message, side: null });
  });
  worker.addEventListener('messageerror', () => {
    end({ code: 'worker', message: 'an unreadable message', side: null });
  });
  const ask = (body: Body): Promise<SavedAnswer> =>
    new Promise((resolve, reject) => {
      if (ended !== null) {
        reject(new SavedMapError(ended));
        return;
      }
      const id = next++;
      waiting.set(id, { resolve, reject });
      // Every request brings the core with it, so that none overtakes the first one while the core loads.
      const request = { ...body, id, module };
      postWithCore(worker, request, (failure) => {
        waiting.delete(id);
        reject(new SavedMapError({ ...failure, side: null }));
      });
    });
  const wrong = (): never => {
    throw new SavedMapError({ code: 'worker', message: 'an answer to another question', side: null });
  };
  return {
    opened: ask({ kind: 'open', show, ...files }).then((answer) => (answer.kind === 'opened' ? answer.opened : wrong())),
    file: async (name) => {
      const answer = await ask({ kind: 'file', name });
      return answer.kind === 'file' ? answer.bytes : wrong();
    },
    wrapped: async () => {
      const answer = await ask({ kind: 'wrap' });
      return answer.kind === 'wrapped' ? answer.wrapped : wrong();
    },
    way: async (points) => {
      const answer = await ask({ kind: 'way', points });
      return answer.kind === 'way' ? answer.way : wrong();
    },
    proof: async () => {
      const answer = await ask({ kind: 'prove' });
      return answer.kind === 'proved' ? answer.proof : wrong();
    },
    close: () => {
      end({ code: 'closed', message: 'the map was closed', side: null });
    },
  };
}
