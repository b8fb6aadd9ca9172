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

/**
 * Prepares something, then works on it. The sentence is there to read before the work holds the page up. Where another
 * task has begun meanwhile the work is left out, so that a slow one does not overwrite a later one.
 */
export async function perform<T>(
  store: Store,
  sentence: string,
  prepare: () => Promise<T> | T,
  work: (prepared: T) => void,
): Promise<void> {
  const task: Task = { sentence };
  store.dispatch({ kind: 'task-begun', task });
  try {
    const prepared = await prepare();
    await painted();
    const { job } = store.state;
    if (job.kind === 'busy' && job.task === task) {
      work(prepared);
    }
  } catch (thrown) {
    store.dispatch({ kind: 'error', sentence: sentenceOf(thrown) });
  } finally {
    store.dispatch({ kind: 'task-ended', task });
  }
}
