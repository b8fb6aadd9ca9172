/** Makes another map in a worker of its own, to be compared with the one on the page. */
import type { Core } from '../compute/core.ts';
import type { OtherMap, Report } from '../report.ts';
import type { Store } from '../store/store.ts';
import { startOtherMap } from './watch.ts';

/** Owns the worker that makes the other map. */
export class Comparer {
  readonly #store: Store;
  readonly #core: () => Core | null;
  #end = (): void => undefined;

  constructor(store: Store, core: () => Core | null) {
    this.#store = store;
    this.#core = core;
    store.subscribe(({ comparison }, previous) => {
      // Whatever withdraws the comparison on the page also ends the worker.
      const isWanted = comparison?.progress.kind === 'computing' && comparison.which === previous.comparison?.which;
      if (previous.comparison?.progress.kind === 'computing' && !isWanted) {
        this.#end();
      }
    });
  }

  /** Compares the map on the page with another one; `null` ends the comparison. */
  choose(which: OtherMap | null): void {
    const { dispatch } = this.#store;
    if (which === null) {
      dispatch({ kind: 'comparison-closed' });
      return;
    }
    const core = this.#core();
    if (core === null) {
      return;
    }
    dispatch({ kind: 'comparison-begun', which });
    const { comparison } = this.#store.state;
    if (comparison?.progress.kind === 'computing') {
      this.#start(core, which);
    }
  }

  #start(core: Core, which: OtherMap): void {
    const { dispatch } = this.#store;
    // A worker that still makes the same map is ended first.
    this.#end();
    this.#end = startOtherMap(
      this.#store,
      core,
      {
        progress: (share) => {
          dispatch({ kind: 'comparison', which, progress: { kind: 'computing', share } });
        },
        done: (output) => {
          const map = { output, report: JSON.parse(output.report) as Report };
          dispatch({ kind: 'comparison', which, progress: { kind: 'there', map } });
        },
        failed: (sentence) => {
          dispatch({ kind: 'comparison', which, progress: { kind: 'failed', sentence } });
        },
      },
      which,
    );
  }
}
