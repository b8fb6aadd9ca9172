/** Opens files that were dropped, chosen or pasted: for a link that waits for them, as a project, or as meshes, landmarks and maps. */
import type { Side } from '../landmarks.ts';
import { isProject } from '../send/project.ts';
import type { Store } from '../store/store.ts';
import type { Links } from './links.ts';
import type { Openers } from './open.ts';
import { bytesOf, openFiles } from './open.ts';
import { openProject } from './projects.ts';
import { errorOf } from './task.ts';

const PROJECT = /\.zip$/i;

/**
 * For each page the promise that it has read the latest files, while it reads them. It never rejects: the files that follow only wait for
 * its end.
 */
const LAST = new WeakMap<Store, Promise<void>>();

interface Places extends Openers {
  readonly links: Pick<Links, 'waits' | 'cancel' | 'take'>;
}

/**
 * Opens files for the place that they belong to; `side` is the view they were dropped on or chosen for. Files that come while others are
 * being read wait for these, so that none is lost; an error about the earlier files stays on the page beside one about the later files.
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
  // The user has begun another task since, and it takes precedence over these files.
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
