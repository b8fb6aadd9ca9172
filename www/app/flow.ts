/** The flows of the map on the page, from step to step, for whoever looks at them. */
import { startFlows } from '../compute/flow-client.ts';
import type { Flows } from '../compute/flow-messages.ts';
import { failureSentence } from '../messages.ts';
import type { FlowHands } from '../method/hands.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { shownResult } from '../store/staleness.ts';
import type { Store } from '../store/store.ts';

/** What was computed stays as long as its map does. */
const KNOWN = new WeakMap<object, Flows>();

/** Computes the flows of the map on the page in a worker; returns what ends that. */
export function startFlow(store: Store, core: WebAssembly.Module | null, listener: Parameters<FlowHands['start']>[0]): () => void {
  const result = shownResult(store.state);
  const [source, target] = result?.inputs.meshes ?? [];
  if (core === null || result === null || source === undefined || source === null || target === undefined || target === null) {
    return () => undefined;
  }
  const known = KNOWN.get(result.output);
  if (known !== undefined) {
    queueMicrotask(() => {
      listener.done(known);
    });
    return () => undefined;
  }
  const landmarks = JSON.stringify(landmarkFileOf(result.inputs));
  return startFlows(
    { module: core, source: source.bytes, target: target.bytes, landmarks, cones: result.output.cones },
    {
      progress: listener.progress,
      done: (flows) => {
        KNOWN.set(result.output, flows);
        listener.done(flows);
      },
      failed: (failure) => {
        console.error(failure);
        listener.failed(failureSentence(failure));
      },
    },
  );
}
