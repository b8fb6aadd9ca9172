/** Parts of the method of the map on the page, done again for whoever looks at them. */
import { startWatched } from '../compute/watch-client.ts';
import type { Watchable, Watched } from '../compute/watch-messages.ts';
import { failureSentence } from '../messages.ts';
import type { WatchHands } from '../method/hands.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { shownResult } from '../store/staleness.ts';
import type { Store } from '../store/store.ts';

/** What was computed stays as long as its map does. */
const KNOWN = new WeakMap<object, Partial<Watched>>();

/** Computes what is wanted of the map on the page in a worker; returns what ends that. */
export function startWatching<W extends Watchable>(
  store: Store,
  core: WebAssembly.Module | null,
  wanted: W,
  listener: Parameters<WatchHands<W>['start']>[0],
): () => void {
  const result = shownResult(store.state);
  const [source, target] = result?.inputs.meshes ?? [];
  if (core === null || result === null || source === undefined || source === null || target === undefined || target === null) {
    return () => undefined;
  }
  const { output, inputs } = result;
  const known = KNOWN.get(output);
  const answer: Watched[W] | undefined = known?.[wanted];
  if (answer !== undefined) {
    queueMicrotask(() => {
      listener.done(answer);
    });
    return () => undefined;
  }
  const landmarks = JSON.stringify(landmarkFileOf(inputs));
  return startWatched(
    { wanted, module: core, source: source.bytes, target: target.bytes, landmarks, cones: output.cones },
    {
      progress: listener.progress,
      done: (found) => {
        KNOWN.set(output, { ...KNOWN.get(output), [wanted]: found });
        listener.done(found);
      },
      failed: (failure) => {
        console.error(failure);
        listener.failed(failureSentence(failure));
      },
    },
  );
}
