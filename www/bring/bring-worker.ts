/** The worker that brings files across a map: it answers one request, then is ended. */
import { failureField, failureOf } from '../compute/messages.ts';
import { progressListener } from '../compute/progress-listener.ts';
import { writeArchive } from '../send/archive.ts';
import init, { bringAcross, givenFile } from '../wasm/core.js';
import type { Answers, BringFailure, BringMessage, BringRequest, Brought, GivenFileReport } from './messages.ts';
import { separatorFault } from './separators.ts';

declare const self: DedicatedWorkerGlobalScope;

const LISTENER = progressListener((share) => {
  post({ kind: 'progress', share });
});

/** A failure that does not come from the core. */
class Failed extends Error {
  readonly failure: BringFailure;

  constructor(failure: BringFailure) {
    super(failure.message);
    this.failure = failure;
  }
}

function post(message: BringMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

/** The file that a failure of the core names. */
function fileOf(thrown: unknown): BringFailure['file'] {
  const file = failureField(thrown, 'file');
  return typeof file === 'number' || file === 'source' || file === 'target' ? file : null;
}

async function bytesOf(file: Blob, number: number): Promise<Uint8Array> {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch {
    throw new Failed({ code: 'unreadable', message: 'it could not be read from the disk', file: number });
  }
}

/** What each file may hold; only one file at a time is in memory. */
async function lookedAt(files: readonly Blob[]): Promise<readonly GivenFileReport[]> {
  const reports: GivenFileReport[] = [];
  for (const [number, file] of files.entries()) {
    const bytes = await bytesOf(file, number);
    try {
      reports.push(JSON.parse(givenFile(bytes)) as GivenFileReport);
    } catch (thrown) {
      const failure = failureOf(thrown);
      const message = failure.code === 'transfer' ? (separatorFault(bytes) ?? failure.message) : failure.message;
      throw new Failed({ ...failure, message, file: number });
    }
    post({ kind: 'progress', share: (number + 1) / files.length });
  }
  return reports;
}

async function brought({ map, source, target, files, wish }: Extract<BringRequest, { kind: 'bring' }>): Promise<Brought> {
  const given = await Promise.all(files.map(bytesOf));
  const result = bringAcross(map, source, target, given, JSON.stringify(wish), LISTENER);
  const count = result.count();
  const entries = Object.fromEntries(Array.from({ length: count }, (_, k) => [result.name(k), result.take(k)]));
  const [first] = Object.entries(entries);
  const remark = result.remark() ?? null;
  result.free();
  if (first !== undefined && count === 1) {
    return { only: first[0], bytes: first[1].slice(), count, remark };
  }
  return { only: null, bytes: writeArchive(entries), count, remark };
}

async function answerTo(request: BringRequest): Promise<Answers[keyof Answers]> {
  await init({ module_or_path: request.module });
  return request.kind === 'look' ? lookedAt(request.files) : brought(request);
}

async function hear(request: BringRequest): Promise<void> {
  try {
    const answer = await answerTo(request);
    post({ kind: 'done', answer }, 'bytes' in answer ? [answer.bytes.buffer] : []);
  } catch (thrown) {
    post({ kind: 'failed', failure: thrown instanceof Failed ? thrown.failure : { ...failureOf(thrown), file: fileOf(thrown) } });
  }
}

self.addEventListener('message', (event: MessageEvent<BringRequest>) => {
  void hear(event.data);
});
