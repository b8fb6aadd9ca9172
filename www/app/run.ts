/** The run of the page: starts it, cancels it, and asks it to finish early. */
import { startRun, warmUp } from '../compute/client.ts';
import type { Core } from '../compute/core.ts';
import type { Run, RunListener } from '../compute/client.ts';
import { failureSentence, SENTENCES } from '../messages.ts';
import type { Report } from '../report.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { canRun, needsRun } from '../store/readiness.ts';
import type { Store } from '../store/store.ts';

/** Owns the workers of runs. Beside the store it is the only object of the page that changes. */
export class Runner {
  readonly #store: Store;
  #core: () => Core | null = () => null;
  #run: Run | null = null;
  #endWarmUp = (): void => undefined;

  constructor(store: Store) {
    this.#store = store;
    store.subscribe(({ matching }, previous) => {
      // A search has the core optimised itself, and the processor to itself.
      if (matching?.kind === 'searching' && previous.matching?.kind !== 'searching') {
        this.#endWarmUp();
      }
    });
  }

  /** The core, loaded or still loading; `null` until it is known where it comes from. */
  get core(): Core | null {
    return this.#core();
  }

  /** Takes the function that gives the core; no run starts without it. */
  use(core: () => Core): void {
    this.#core = core;
  }

  /** Has the browser optimise the core by making the map of a demo, given by its id; a run or a search that begins ends that. */
  warmUp(demo: string): void {
    const { core } = this;
    const isSearching = this.#store.state.matching?.kind === 'searching';
    if (core !== null && this.#run === null && !isSearching) {
      this.#endWarmUp();
      this.#endWarmUp = warmUp({ module: core, demo });
    }
  }

  /** Computes the map of the meshes and landmarks on the page. */
  start(): void {
    const { state, dispatch } = this.#store;
    const [source, target] = state.meshes;
    const { core } = this;
    if (core === null || source === null || target === null || !canRun(state)) {
      return;
    }
    if (!needsRun(state)) {
      dispatch({ kind: 'toast', sentence: SENTENCES.upToDate, undo: false });
      return;
    }
    this.#endWarmUp();
    dispatch({ kind: 'run-started' });
    this.#run = startRun(
      {
        module: core,
        source: source.bytes,
        target: target.bytes,
        pictures: [source.picture, target.picture],
        landmarks: JSON.stringify(landmarkFileOf(state)),
        options: state.options,
        demo: state.demo?.id ?? null,
      },
      this.#listener(),
    );
  }

  /** Cancels the run at once. */
  cancel(): void {
    this.#run?.cancel();
    this.#run = null;
    if (this.#store.state.job.kind === 'running') {
      this.#store.dispatch({ kind: 'run-cancelled' });
    }
  }

  /** Asks the run to finish with the map as it is. */
  finish(): void {
    this.#run?.finish();
    this.#store.dispatch({ kind: 'run-finish' });
  }

  #listener(): RunListener {
    const { dispatch } = this.#store;
    return {
      progress: (progress) => {
        dispatch({ kind: 'run-progress', progress });
      },
      relaxes: () => {
        dispatch({ kind: 'run-relaxes' });
      },
      preview: (places) => {
        dispatch({ kind: 'run-preview', places });
      },
      finishable: () => {
        dispatch({ kind: 'run-finishable' });
      },
      found: (findings) => {
        dispatch({ kind: 'run-found', findings });
      },
      done: (output) => {
        this.#run = null;
        dispatch({ kind: 'run-done', output, report: JSON.parse(output.report) as Report });
      },
      failed: (failure) => {
        this.#run = null;
        console.error(failure);
        dispatch({ kind: 'run-failed', sentence: failureSentence(failure), failure });
      },
    };
  }
}
