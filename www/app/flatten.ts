/** Computes the flows of the map on the page in a worker of their own, as soon as a heat map needs their values. */
import type { Core } from '../compute/core.ts';
import { USUAL_SCHEME } from '../options.ts';
import { wantsFlows } from '../store/flat.ts';
import { shownResult } from '../store/staleness.ts';
import type { Flattening } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { startFlowing } from './watch.ts';

/** Owns the worker that computes the flows. */
export class Flattener {
  readonly #store: Store;
  readonly #core: () => Core | null;
  #end = (): void => undefined;

  constructor(store: Store, core: () => Core | null) {
    this.#store = store;
    this.#core = core;
    store.subscribe((state, previous) => {
      // Whatever removes the flows from the page also ends the worker.
      if (previous.flattening?.progress.kind === 'computing' && state.flattening === null) {
        this.#end();
      }
      if (wantsFlows(state)) {
        // The listeners of the store must all have heard of this change before the next one.
        queueMicrotask(() => {
          this.#start();
        });
      }
    });
  }

  #start(): void {
    const { state, dispatch } = this.#store;
    const [core, of] = [this.#core(), shownResult(state)];
    if (core === null || of === null || !wantsFlows(state)) {
      return;
    }
    const tell = (progress: Flattening['progress']): void => {
      dispatch({ kind: 'flattening', flattening: { of, progress } });
    };
    tell({ kind: 'computing', share: 0 });
    this.#end = startFlowing(
      this.#store,
      core,
      {
        progress: (share) => {
          tell({ kind: 'computing', share });
        },
        done: (flows) => {
          tell({ kind: 'there', flows });
        },
        failed: (sentence) => {
          tell({ kind: 'failed', sentence });
        },
      },
      USUAL_SCHEME,
    );
  }
}
