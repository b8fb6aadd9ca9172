/** Chooses what the page shows before the user opens anything: what the address names, else the first demo. */
import type { Reader } from '../reading/reader.ts';
import type { Demo } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { Links } from './links.ts';
import { openDemo } from './open.ts';

export class First {
  readonly #store: Store;
  readonly #links: Links;
  readonly #reader: Reader;

  constructor(store: Store, links: Links, reader: Reader) {
    this.#store = store;
    this.#links = links;
    this.#reader = reader;
  }

  /** Whether nothing is on the page, nor on its way. */
  isMissing(): boolean {
    const { meshes, receiving, job } = this.#store.state;
    return meshes.every((file) => file === null) && receiving.kind === 'nothing' && job.kind === 'idle';
  }

  /** The demo that the address names, or the first one where it names nothing; `null` where the address names something else. */
  expected(demos: readonly Demo[]): Demo | null {
    const { named } = this.#links;
    return (named === null ? demos[0] : demos.find(({ id }) => id === named)) ?? null;
  }

  /** Opens the demo that a new visitor sees first; returns whether it has come. */
  async open(demos: readonly Demo[]): Promise<boolean> {
    const [first] = demos;
    return first !== undefined && openDemo(this.#store, this.#reader, first.id);
  }

  /** Shows what the address names, else the first demo, unless the user has already put something on the page. */
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
