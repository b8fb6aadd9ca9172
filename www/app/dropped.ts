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

interface Places extends Openers {
  readonly links: Pick<Links, 'waits' | 'cancel' | 'take'>;
}

/** Opens the files of one page. Files that come before the page can open any wait until it has begun. */
export class Dropped {
  readonly #store: Store;
  readonly #places: Places;
  /** Settled when the latest files are read, while they are. It never rejects: the files that follow only wait for its end. */
  #latest: Promise<void> | null = null;
  /** Lets the files begin that wait for the page to begin; `null` where there are none. */
  #letBegin: (() => void) | null = null;

  constructor(store: Store, places: Places) {
    this.#store = store;
    this.#places = places;
  }

  /** Whether files have come that wait for the page to begin. */
  get areWaiting(): boolean {
    return this.#letBegin !== null;
  }

  /**
   * Opens files for the place that they belong to; `side` is the view they were dropped on or chosen for. Files that come while others
   * are being read wait for these, so that none is lost; an error about the earlier files stays on the page beside one about the later
   * files.
   */
  async open(files: readonly File[], side: Side | null): Promise<void> {
    if (!this.#store.state.ready) {
      this.#latest ??= new Promise((resolve) => {
        this.#letBegin = resolve;
      });
    }
    const opened = this.#latest === null ? this.#openNow(files, side) : this.#openAfter(this.#latest, files, side);
    const ended = opened.catch(() => undefined);
    this.#latest = ended;
    try {
      await opened;
    } finally {
      if (this.#latest === ended) {
        this.#latest = null;
      }
    }
  }

  /** Opens the files that waited for the page to begin, onto what is on it now. */
  begin(): void {
    this.#letBegin?.();
    this.#letBegin = null;
  }

  async #openAfter(before: Promise<void>, files: readonly File[], side: Side | null): Promise<void> {
    await before;
    const { error: refused, job } = this.#store.state;
    // The user has begun another task since, and it takes precedence over these files.
    if (job.kind === 'busy') {
      return;
    }
    await this.#openNow(files, side);
    const { error } = this.#store.state;
    if (refused !== null && error !== refused) {
      this.#store.dispatch({ kind: 'error', sentence: error === null ? refused : `${refused} ${error}` });
    }
  }

  async #openNow(files: readonly File[], side: Side | null): Promise<void> {
    const store = this.#store;
    const { links, ...openers } = this.#places;
    const [first] = files;
    const isForLink = links.waits;
    if (first === undefined) {
      return;
    }
    if (store.state.job.kind === 'running' || (!isForLink && !(files.length === 1 && PROJECT.test(first.name)))) {
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
}
