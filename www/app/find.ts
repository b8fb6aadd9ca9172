/** Looks for landmarks in a worker of its own, while the page can be used. */
import type { Core } from '../compute/core.ts';
import { startMatch } from '../compute/match-client.ts';
import { failureSentence } from '../messages.ts';
import type { MatchReport } from '../report.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { canSearch } from '../store/search.ts';
import type { Store } from '../store/store.ts';

/** Owns the worker of the search. */
export class Finder {
  readonly #store: Store;
  readonly #core: () => Core | null;
  #end = (): unknown => undefined;

  constructor(store: Store, core: () => Core | null) {
    this.#store = store;
    this.#core = core;
    store.subscribe(({ matching }, previous) => {
      // Whatever ends the search on the page also ends the worker.
      if (previous.matching?.kind === 'searching' && matching?.kind !== 'searching') {
        this.#end();
      }
    });
  }

  /** Looks for landmarks of the meshes on the page; pairs that have both points are held. */
  start(): void {
    const { state, dispatch } = this.#store;
    const [source, target] = state.meshes;
    const module = this.#core();
    if (module === null || source === null || target === null || !canSearch(state)) {
      return;
    }
    dispatch({ kind: 'search-begun' });
    const landmarks = JSON.stringify(landmarkFileOf(state));
    // The first change of meshes or pairs ends the worker, so that its answer is always about what is on the page.
    this.#end = startMatch(
      { module, source: source.bytes, target: target.bytes, landmarks },
      {
        progress: (share) => {
          dispatch({ kind: 'search-progress', share });
        },
        preview: (places, pairs) => {
          dispatch({ kind: 'search-preview', places, pairs });
        },
        done: (report, pictures) => {
          dispatch({ kind: 'search-done', report: JSON.parse(report) as MatchReport, pictures });
        },
        failed: (failure) => {
          console.error(failure);
          dispatch({ kind: 'search-closed' }, { kind: 'error', sentence: failureSentence(failure), failure });
        },
      },
    );
  }
}
