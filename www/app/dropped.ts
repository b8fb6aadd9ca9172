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

/** Brings files where they belong; `side` is the view they were dropped on or chosen for. */
export async function openDropped(
  store: Store,
  { links, ...openers }: { readonly links: Links } & Openers,
  files: readonly File[],
  side: Side | null,
): Promise<void> {
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
