/** Chooses what the page shows before it opens the user's files: what the address names, else the first demo where no file waits. */
import type { Reader } from '../reading/reader.ts';
import type { Demo } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { Dropped } from './dropped.ts';
import type { Links } from './links.ts';
import { openDemo } from './open.ts';

export class First {
  readonly #store: Store;
  readonly #links: Links;
  readonly #reader: Reader;
  readonly #dropped: Pick<Dropped, 'areWaiting'>;

  constructor(store: Store, links: Links, reader: Reader, dropped: Pick<Dropped, 'areWaiting'>) {
    this.#store = store;
    this.#links = links;
    this.#reader = reader;
    this.#dropped = dropped;
  }

  /** Whether nothing is on the page, nor on its way. */
  isMissing(): boolean {
    const { meshes, receiving, job } = this.#store.state;
    const isEmpty = meshes.every((file) => file === null) && !this.#dropped.areWaiting;
    return isEmpty && receiving.kind === 'nothing' && job.kind === 'idle';
  }

  /**
   * The demo that the address names, or the first one where it names nothing and no file waits; `null` where the address names something
   * else.
   */
  expected(demos: readonly Demo[]): Demo | null {
    const { named } = this.#links;
    const unnamed = this.#dropped.areWaiting ? null : demos[0];
    return (named === null ? unnamed : demos.find(({ id }) => id === named)) ?? null;
  }

  /** Opens the demo that a new visitor sees first; returns whether it has come. */
  async open(demos: readonly Demo[]): Promise<boolean> {
    const [first] = demos;
    return first !== undefined && openDemo(this.#store, this.#reader, first.id);
  }

  /** Shows what the address names, else the first demo, unless the user has already put something on the page or files wait for it. */
  async show(demos: readonly Demo[]): Promise<void> {
    const { job, history } = this.#store.state;
    if (job.kind !== 'idle' || history.past.length > 0) {
      return;
    }
    const followed = await this.#links.follow();
    const { error } = this.#store.state;
    // A visitor whose link brings nothing sees the first demo, and a sentence that says why.
    if (this.isMissing() ? await this.open(demos) : followed === 'opened') {
      this.#store.dispatch({ kind: 'history-begun' });
    }
    if (error !== null) {
      this.#store.dispatch({ kind: 'error', sentence: error });
    }
  }
}
