/** Parts of the method that are done again to be watched: answers one request, then is thrown away. */
import init, { recordCarriedSimplification, recordFlows, recordSimplifications } from '../wasm/core.js';
import type { RecordedFlows, Simplifications as RecordedSimplifications } from '../wasm/core.js';
import { failureOf } from './messages.ts';
import type { Flows, SideFlow, Simplification, Simplifications, WatchMessage, WatchRequest } from './watch-messages.ts';

declare const self: DedicatedWorkerGlobalScope;

const LISTENER = {
  progress: (_stage: string, _sentence: string, share: number): void => {
    post({ kind: 'progress', share });
  },
  relaxes: (): void => undefined,
  found: (): void => undefined,
  preview: (): void => undefined,
  wantsResult: (): boolean => false,
};

function post(message: WatchMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

function flowOf(flows: RecordedFlows, side: number): SideFlow {
  const steps = JSON.parse(flows.steps(side)) as Pick<SideFlow, 'moments' | 'converged'>;
  return { ...steps, logFactors: flows.logFactors(side) };
}

function simplificationOf(stages: RecordedSimplifications, side: number): Simplification {
  return { positions: stages.positions(side), triangles: stages.triangles(side), counts: stages.counts(side) };
}

function answerTo({ wanted, source, target, landmarks, cones, carried }: WatchRequest): Flows | Simplifications {
  switch (wanted) {
    case 'flows': {
      const flows = recordFlows(source, target, landmarks, cones, LISTENER);
      return [flowOf(flows, 0), flowOf(flows, 1)];
    }
    case 'simplifications': {
      const stages =
        carried === null
          ? recordSimplifications(source, target, landmarks, LISTENER)
          : recordCarriedSimplification(carried.map, source, target, landmarks, carried.from, LISTENER);
      return [simplificationOf(stages, 0), simplificationOf(stages, 1)];
    }
  }
}

async function run(request: WatchRequest): Promise<void> {
  try {
    await init({ module_or_path: request.module });
    const answer = answerTo(request);
    const arrays = answer.flatMap((side) => Object.values(side) as readonly unknown[]).filter((value) => ArrayBuffer.isView(value));
    post({ kind: 'done', answer }, arrays.map(({ buffer }) => buffer).filter((buffer) => buffer instanceof ArrayBuffer));
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<WatchRequest>) => {
  void run(event.data);
});
