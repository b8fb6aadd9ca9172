/** Computes parts of the method of the map on the page again, for the user to watch. */
import type { Core } from '../compute/core.ts';
import type { Failure } from '../compute/messages.ts';
import type { OtherMap, Scheme } from '../report.ts';
import { startWatched } from '../compute/watch-client.ts';
import type { Flows, OtherOutput, Simplifications, SimplifiedFrom, Watchable, Watched, WatchRequest } from '../compute/watch-messages.ts';
import { lateModule } from '../late-module.ts';
import { failureSentence } from '../messages.ts';
import type { Listener } from '../method/hands.ts';
import type { Planes } from '../method/plane-client.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result } from '../store/state.ts';
import type { Store } from '../store/store.ts';

/** For each map, what was computed of it, by the key of the wish; it stays as long as the map does. */
const KNOWN = new WeakMap<object, Map<string, Watched[Watchable]>>();

// Whoever looks at the planes has already fetched the module that draws them; their client comes with it.
const loadPlanes = lateModule(() => import('../method/plane-client.ts'));

const nothing = (): void => undefined;

interface Work {
  readonly result: Result;
  /** The part of the request that every worker needs. */
  readonly begun: { readonly module: Core; readonly source: Uint8Array; readonly target: Uint8Array; readonly landmarks: string; readonly cones: Float64Array };
}

/** The map on the page, with what it was made from; `null` where there is none. */
function shownWork(store: Store, core: Core | null): Work | null {
  const result = shownResult(store.state);
  const [source, target] = result?.inputs.meshes ?? [];
  if (core === null || result === null || source === undefined || source === null || target === undefined || target === null) {
    return null;
  }
  const { output, inputs } = result;
  const landmarks = JSON.stringify(landmarkFileOf(inputs));
  return { result, begun: { module: core, source: source.bytes, target: target.bytes, landmarks, cones: output.cones } };
}

function failing(failed: (sentence: string) => void): (failure: Failure) => void {
  return (failure) => {
    console.error(failure);
    failed(failureSentence(failure));
  };
}

/** What is wanted of a map, beyond what it was made from. */
type Wish<W extends Watchable> = { readonly wanted: W } & Pick<WatchRequest, 'scheme' | 'carried' | 'other'>;

/** Computes what is wanted in a worker, or answers at once where it is known; `key` identifies the wish. */
function startWish<W extends Watchable>({ result, begun }: Work, wish: Wish<W>, key: string, listener: Listener<Watched[W]>): () => void {
  const known = KNOWN.get(result.output) ?? new Map<string, Watched[Watchable]>();
  KNOWN.set(result.output, known);
  // The answer under a key is always of the type that its wish asks for.
  const answer = known.get(key) as Watched[W] | undefined;
  if (answer !== undefined) {
    queueMicrotask(() => {
      listener.done(answer);
    });
    return nothing;
  }
  return startWatched(
    { ...begun, ...wish },
    {
      progress: listener.progress,
      done: (found) => {
        known.set(key, found);
        listener.done(found);
      },
      failed: failing(listener.failed),
    },
  );
}

/** Computes the flows of the map on the page in a worker; the returned function ends it. */
export function startFlowing(store: Store, core: Core | null, listener: Listener<Flows>, scheme: Scheme): () => void {
  const work = shownWork(store, core);
  return work === null ? nothing : startWish(work, { wanted: 'flows', scheme, carried: null, other: null }, `flows ${scheme}`, listener);
}

/** Computes the simplification in the same way. */
export function startSimplifying(store: Store, core: Core | null, listener: Listener<Simplifications>, from: SimplifiedFrom): () => void {
  const work = shownWork(store, core);
  if (work === null) {
    return nothing;
  }
  const { map } = work.result.output;
  const carried = from === 'each' || map === null ? null : { from, map };
  return startWish(work, { wanted: 'simplifications', scheme: null, carried, other: null }, `simplifications ${from}`, listener);
}

/** Computes another map of the same meshes, landmarks and options in the same way. */
export function startOtherMap(store: Store, core: Core | null, listener: Listener<OtherOutput>, which: OtherMap): () => void {
  const work = shownWork(store, core);
  if (work === null) {
    return nothing;
  }
  const { options, demo } = work.result.inputs;
  const other = { which, options, demo: demo?.id ?? null };
  return startWish(work, { wanted: 'other-map', scheme: null, carried: null, other }, `other-map ${which}`, listener);
}

/** Computes both flat metrics of the map on the page in a worker, which lays them out until it is ended. */
export function startLayingOut(store: Store, core: Core | null, listener: Listener<Planes>): () => void {
  const work = shownWork(store, core);
  if (work === null) {
    return nothing;
  }
  let end = nothing;
  let isOver = false;
  const failed = failing(listener.failed);
  loadPlanes().then(
    ({ startPlanes }) => {
      if (!isOver) {
        end = startPlanes({ ...work.begun, base: work.result.output.base }, { ...listener, failed });
      }
    },
    (thrown: unknown) => {
      failed({ code: 'worker', message: String(thrown) });
    },
  );
  return () => {
    isOver = true;
    end();
  };
}
