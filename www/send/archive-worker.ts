/** The worker that packs and unpacks archives. */
import type { ArchiveAnswer, ArchiveRequest } from './archive.ts';
import { ArchiveRefused, readArchive, writeArchive } from './archive.ts';

declare const self: DedicatedWorkerGlobalScope;

function answer(request: ArchiveRequest): ArchiveAnswer {
  try {
    return request.kind === 'write'
      ? { kind: 'written', bytes: writeArchive(request.entries) }
      : { kind: 'read', entries: readArchive(request.bytes, request.names) };
  } catch (thrown) {
    if (thrown instanceof ArchiveRefused) {
      return { kind: 'refused', fault: thrown.fault };
    }
    throw thrown;
  }
}

self.addEventListener('message', (event: MessageEvent<ArchiveRequest>) => {
  const answered = answer(event.data);
  const files =
    answered.kind === 'written' ? [answered.bytes] : answered.kind === 'read' ? Object.values(answered.entries) : [];
  self.postMessage(answered, [...new Set(files.map(({ buffer }) => buffer))]);
});
