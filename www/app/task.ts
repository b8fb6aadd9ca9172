/** Work other than a run: the page says what it does, and one work takes the place of another. */
import { failureOf } from '../compute/messages.ts';
import { FileRefused } from '../files.ts';
import { failureSentence } from '../messages.ts';
import type { Event } from '../store/events.ts';
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

/** What was thrown, as it is told to the page. */
export function errorOf(thrown: unknown): Extract<Event, { readonly kind: 'error' }> {
  if (thrown instanceof FileRefused) {
    return { kind: 'error', sentence: thrown.message, ...(thrown.failure === null ? {} : { failure: thrown.failure }) };
  }
  const failure = failureOf(thrown);
  return { kind: 'error', sentence: failureSentence(failure), failure };
}

/** The user has had enough of the task that the page is busy with, if there is one. */
export function leaveTask(store: Store): void {
  const { job } = store.state;
  if (job.kind === 'busy') {
    store.dispatch({ kind: 'task-ended', task: job.task });
  }
}

/** Prepares something and uses it, while the page says so; beside a run or another task, which is not given up for it. */
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
  // Nobody waits for a preparation that was left, also where it does not hear the signal.
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
    store.dispatch(errorOf(thrown));
    return 'failed';
  } finally {
    unsubscribe();
    store.dispatch({ kind: 'task-ended', task });
  }
}
