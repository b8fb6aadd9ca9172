/** Work other than a run: the page says what it does, and one work takes the place of another. */
import { failureOf } from '../compute/messages.ts';
import { FileRefused } from '../files.ts';
import { failureSentence } from '../messages.ts';
import type { Task } from '../store/job.ts';
import type { Store } from '../store/store.ts';

/** After this time in ms the work begins unseen: a page in the background draws no frames. */
const PAINTED_AT_LATEST = 200;

/** Lets the browser draw what was said before the page is busy. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, PAINTED_AT_LATEST);
    requestAnimationFrame(() => {
      clearTimeout(timer);
      setTimeout(resolve, 0);
    });
  });
}

/** What was thrown, in words. */
export function sentenceOf(thrown: unknown): string {
  return thrown instanceof FileRefused ? thrown.message : failureSentence(failureOf(thrown));
}

/** The user has had enough of the task that the page is busy with, if there is one. */
export function leaveTask(store: Store): void {
  const { job } = store.state;
  if (job.kind === 'busy') {
    store.dispatch({ kind: 'task-ended', task: job.task });
  }
}

/** What became of a work: done, broken off with a sentence, or left out because another one had begun. */
export type Outcome = 'done' | 'failed' | 'left-out';

/**
 * Prepares something, then works on it. The sentence is there to read before the work holds the page up. Where another task has
 * begun meanwhile, or the user has had enough of this one, the signal tells its preparation and the work is left out, so that a
 * slow one does not overwrite a later one.
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
  try {
    const [prepared] = await Promise.all([prepare(leaving.signal), painted()]);
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
    store.dispatch({ kind: 'error', sentence: sentenceOf(thrown) });
    return 'failed';
  } finally {
    unsubscribe();
    store.dispatch({ kind: 'task-ended', task });
  }
}
