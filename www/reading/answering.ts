/** What both workers of the reader have in common: they answer one question after the other with their wasm module. */
import { failureOf } from '../compute/messages.ts';
import { failureSentence } from '../messages.ts';
import { FileRefused } from '../named-file.ts';
import type { Answers, Question, ReaderAnswer, ReaderRequest } from './messages.ts';

declare const self: DedicatedWorkerGlobalScope;

type Asked<Q extends Question> = Extract<ReaderRequest<Q>, { kind: 'question' }>;
/** A module that is being initialised. */
type Begun = Promise<{ readonly memory: WebAssembly.Memory }>;
type Outcome = ReaderAnswer extends infer A ? (A extends ReaderAnswer ? Omit<A, 'id' | 'memory'> : never) : never;

/** The buffers in an answer, to be transferred without a copy. */
function buffersIn(answer: unknown): ArrayBufferLike[] {
  if (answer instanceof Uint8Array) {
    return [answer.buffer];
  }
  return typeof answer === 'object' && answer !== null ? Object.values(answer).flatMap(buffersIn) : [];
}

/** Why there is no answer. An error that the core reports is a string; anything else broke the core. */
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

/** Answers the questions of the page by a module: `init` initialises it, and `answerTo` asks it. */
export function answerQuestions<Q extends Question>(
  init: (given: { readonly module_or_path: WebAssembly.Module }) => Begun,
  answerTo: (question: Q) => Answers[Q['kind']],
): void {
  const answer = async (module: Begun, { id, question }: Asked<Q>): Promise<void> => {
    let size = 0;
    let outcome: Outcome;
    try {
      const { memory } = await module;
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
  };
  // An error outside of any answer is reported as an error of the worker.
  const begin = (module: Begun, asked: Asked<Q>): void => {
    answer(module, asked).catch((thrown: unknown) => {
      self.reportError(thrown);
    });
  };

  let module: Begun | null = null;
  /** Questions that came before the module was loaded. */
  const early: Asked<Q>[] = [];
  self.addEventListener('message', ({ data }: MessageEvent<ReaderRequest<Q>>) => {
    if (data.kind === 'question') {
      if (module === null) {
        early.push(data);
      } else {
        begin(module, data);
      }
      return;
    }
    const begun = init({ module_or_path: data.module });
    module = begun;
    early.splice(0).forEach((asked) => {
      begin(begun, asked);
    });
  });
}
