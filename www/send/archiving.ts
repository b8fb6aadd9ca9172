/** Packs and unpacks archives in a worker, so that the page can be used while large ones are packed. */
import type { ArchiveAnswer, ArchiveRequest, Archiver } from './archive.ts';
import { ArchiveRefused } from './archive.ts';

/** Asks a worker of its own for each request: packing is rare, and the worker's memory is freed afterwards. */
function asked(request: ArchiveRequest, handedOver: Transferable[]): Promise<ArchiveAnswer> {
  const worker = new Worker(new URL('./archive-worker.ts', import.meta.url), { type: 'module' });
  return new Promise<ArchiveAnswer>((resolve, reject) => {
    worker.addEventListener('message', (event: MessageEvent<ArchiveAnswer>) => {
      resolve(event.data);
    });
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      reject(new Error(event.message));
    });
    worker.postMessage(request, handedOver);
  }).finally(() => {
    worker.terminate();
  });
}

export const inWorker: Archiver = {
  async write(entries) {
    const answer = await asked({ kind: 'write', entries }, []);
    if (answer.kind !== 'written') {
      throw new Error('the archive was not written');
    }
    return answer.bytes;
  },
  async read(bytes, names) {
    const answer = await asked({ kind: 'read', bytes, names }, [bytes.buffer]);
    if (answer.kind !== 'read') {
      throw new ArchiveRefused(answer.kind === 'refused' ? answer.fault : 'no-archive');
    }
    return answer.entries;
  },
};
