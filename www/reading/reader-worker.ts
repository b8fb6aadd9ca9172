/** Reads files beside the page: answers one question after the other. */
import { failureOf } from '../compute/messages.ts';
import { failureSentence } from '../messages.ts';
import { FileRefused } from '../named-file.ts';
import type { InitOutput } from '../wasm/page.js';
import init from '../wasm/page.js';
import { answerTo } from './answers.ts';
import type { ReaderAnswer, ReaderRequest } from './messages.ts';

declare const self: DedicatedWorkerGlobalScope;

type Asked = Extract<ReaderRequest, { kind: 'question' }>;
type Outcome = ReaderAnswer extends infer A ? (A extends ReaderAnswer ? Omit<A, 'id' | 'memory'> : never) : never;

/** The buffers of an answer, to be handed over. */
function buffersIn(answer: unknown): ArrayBufferLike[] {
  if (answer instanceof Uint8Array) {
    return [answer.buffer];
  }
  return typeof answer === 'object' && answer !== null ? Object.values(answer).flatMap(buffersIn) : [];
}

/** Why there is no answer. What the core throws itself is a string; everything else broke it. */
function outcomeOf(thrown: unknown): Outcome {
  if (thrown instanceof FileRefused) {
    const { message: sentence, offer, what } = thrown;
    return { kind: 'refused', refusal: { sentence, offer, what } };
  }
  const failure = failureOf(thrown);
  return typeof thrown === 'string'
    ? { kind: 'refused', refusal: { sentence: failureSentence(failure), offer: null, what: 'file' } }
    : { kind: 'failed', failure };
}

async function answer(core: Promise<InitOutput>, { id, question }: Asked): Promise<void> {
  let size = 0;
  let outcome: Outcome;
  try {
    const { memory } = await core;
    try {
      outcome = { kind: 'answer', answer: answerTo(question) };
    } catch (thrown) {
      outcome = outcomeOf(thrown);
    }
    size = memory.buffer.byteLength;
  } catch (thrown) {
    outcome = { kind: 'failed', failure: failureOf(thrown) };
  }
  const buffers = new Set(buffersIn(outcome).filter((buffer) => buffer instanceof ArrayBuffer));
  self.postMessage({ ...outcome, id, memory: size } satisfies ReaderAnswer, [...buffers]);
}

/** What cannot be answered at all is told as an error of the worker. */
function begin(core: Promise<InitOutput>, asked: Asked): void {
  answer(core, asked).catch((thrown: unknown) => {
    self.reportError(thrown);
  });
}

let core: Promise<InitOutput> | null = null;
/** Questions that came before the core. */
const early: Asked[] = [];

self.addEventListener('message', ({ data }: MessageEvent<ReaderRequest>) => {
  if (data.kind === 'question') {
    if (core === null) {
      early.push(data);
    } else {
      begin(core, data);
    }
    return;
  }
  const begun = init({ module_or_path: data.module });
  core = begun;
  early.splice(0).forEach((asked) => {
    begin(begun, asked);
  });
});
