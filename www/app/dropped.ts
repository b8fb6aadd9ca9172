/** Files that are dropped, chosen or pasted: for a link that waits for them, a project, or meshes, landmarks and maps. */
import type { Side } from '../landmarks.ts';
import { isProject } from '../send/project.ts';
import type { Store } from '../store/store.ts';
import type { Links } from './links.ts';
import type { Openers } from './open.ts';
import { bytesOf, openFiles } from './open.ts';
import { openProject } from './projects.ts';
import { errorOf } from './task.ts';

const PROJECT = /\.zip$/i;

/** By page the reading of what was brought last, as long as it lasts. It never fails: what comes next waits for its end alone. */
const LAST = new WeakMap<Store, Promise<void>>();

interface Places extends Openers {
  readonly links: Pick<Links, 'waits' | 'cancel' | 'take'>;
}

/**
 * Brings files where they belong; `side` is the view they were dropped on or chosen for. What comes while other files are read waits for
 * these, so that none is lost; what was refused among these stays told.
 */
export async function openDropped(store: Store, places: Places, files: readonly File[], side: Side | null): Promise<void> {
  const before = LAST.get(store);
  const opened = before === undefined ? openNow(store, places, files, side) : openAfter(before, store, places, files, side);
  const ended = opened.catch(() => undefined);
  LAST.set(store, ended);
  try {
    await opened;
  } finally {
    if (LAST.get(store) === ended) {
      LAST.delete(store);
    }
  }
}

async function openAfter(before: Promise<void>, store: Store, places: Places, files: readonly File[], side: Side | null): Promise<void> {
  await before;
  const { error: refused, job } = store.state;
  // Something else that was begun meanwhile was wanted last.
  if (job.kind === 'busy') {
    return;
  }
  await openNow(store, places, files, side);
  const { error } = store.state;
  if (refused !== null && error !== refused) {
    store.dispatch({ kind: 'error', sentence: error === null ? refused : `${refused} ${error}` });
  }
}

async function openNow(store: Store, { links, ...openers }: Places, files: readonly File[], side: Side | null): Promise<void> {
  const { ready, job } = store.state;
  const [first] = files;
  const isForLink = links.waits;
  if (!ready || first === undefined) {
    return;
  }
  if (job.kind === 'running' || (!isForLink && !(files.length === 1 && PROJECT.test(first.name)))) {
    await openFiles(store, openers, files, side);
    return;
  }
  try {
    const named = await Promise.all(files.map(bytesOf));
    const [only] = named;
    if (only !== undefined && named.length === 1 && isProject(only.bytes)) {
      links.cancel();
      await openProject(store, openers, only);
    } else if (isForLink) {
      await links.take(named);
    } else {
      await openFiles(store, openers, files, side);
    }
  } catch (thrown) {
    store.dispatch(errorOf(thrown));
  }
}
