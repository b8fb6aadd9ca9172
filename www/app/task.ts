/** Tasks other than a run: the page says what it does, and a new task replaces the one before. */
import type { Failure } from '../compute/messages.ts';
import { failureOf } from '../compute/messages.ts';
import { FileRefused } from '../files.ts';
import { failureSentence } from '../messages.ts';
import type { Event } from '../store/events.ts';
import type { Task } from '../store/job.ts';
import type { Store } from '../store/store.ts';

/** The longest wait for a drawn frame before a task begins, in ms: a page in the background draws no frames. */
const PAINTED_AT_LATEST = 200;

/** Lets the browser draw the sentence about a task before the page is busy. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, PAINTED_AT_LATEST);
    requestAnimationFrame(() => {
      clearTimeout(timer);
      setTimeout(resolve, 0);
    });
  });
}

/** What was thrown, as an event that shows the error on the page. */
export function errorOf(thrown: unknown): Extract<Event, { readonly kind: 'error' }> {
  if (thrown instanceof FileRefused) {
    return { kind: 'error', sentence: thrown.message, ...(thrown.failure === null ? {} : { failure: thrown.failure }) };
  }
  const failure = failureOf(thrown);
  return { kind: 'error', sentence: failureSentence(failure), failure };
}

/** Whether something failed because a part of the program did not load: then nothing is wrong with the files. */
export function isNotThere(failure: Failure | null | undefined): boolean {
  return failure?.code === 'no-core';
}

/** Gives up the task that the page is busy with, if there is one. */
export function leaveTask(store: Store): void {
  const { job } = store.state;
  if (job.kind === 'busy') {
    store.dispatch({ kind: 'task-ended', task: job.task });
  }
}

/**
 * Prepares something and uses it while the page says so. Nothing is done while a run or another task goes on, which is not given up for it.
 */
export async function performBeside<T>(store: Store, sentence: string, prepare: () => Promise<T>, use: (made: T) => void): Promise<void> {
  const { job } = store.state;
  if (job.kind !== 'running' && job.kind !== 'busy') {
    await perform(store, sentence, prepare, use);
    return;
  }
  try {
    use(await prepare());
  } catch (thrown) {
    store.dispatch(errorOf(thrown));
  }
}

/**
 * How a task ended: done, failed with a sentence, failed because a part of the program did not load, which a reload may mend, or left out
 * because another one had begun.
 */
export type Outcome = 'done' | 'failed' | 'not-loaded' | 'left-out';

/**
 * Prepares something, then works on it. The sentence can be read before the work blocks the page. Where another task has begun meanwhile,
 * or the user has given this one up, the signal aborts its preparation and the work is left out, so that a slow task does not overwrite a
 * later one.
 */
export async function perform<T>(
  store: Store,
  sentence: string,
  prepare: (signal: AbortSignal) => Promise<T> | T,
  work: (prepared: T) => void,
): Promise<Outcome> {
  const task: Task = { sentence };
  const leaving = new AbortController();
  store.dispatch({ kind: 'task-begun', task });
  const unsubscribe = store.subscribe(({ job }) => {
    if (job.kind !== 'busy' || job.task !== task) {
      leaving.abort();
    }
  });
  // The task ends at once when it is given up, even where its preparation ignores the signal.
  const left = new Promise<never>((_, reject) => {
    leaving.signal.addEventListener('abort', () => {
      reject(new Error('left'));
    });
  });
  try {
    const [prepared] = await Promise.race([Promise.all([prepare(leaving.signal), painted()]), left]);
    const { job } = store.state;
    if (job.kind !== 'busy' || job.task !== task) {
      return 'left-out';
    }
    work(prepared);
    return 'done';
  } catch (thrown) {
    if (leaving.signal.aborted) {
      return 'left-out';
    }
    const error = errorOf(thrown);
    store.dispatch(error);
    return isNotThere(error.failure) ? 'not-loaded' : 'failed';
  } finally {
    unsubscribe();
    store.dispatch({ kind: 'task-ended', task });
  }
}
