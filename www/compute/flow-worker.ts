/** The flows of both meshes: answers one request, then is thrown away. */
import init, { recordFlows } from '../wasm/conemap.js';
import type { RecordedFlows } from '../wasm/conemap.js';
import type { FlowMessage, FlowRequest, SideFlow } from './flow-messages.ts';
import { failureOf } from './messages.ts';

declare const self: DedicatedWorkerGlobalScope;

function post(message: FlowMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

function sideOf(flows: RecordedFlows, side: number): SideFlow {
  const steps = JSON.parse(flows.steps(side)) as Pick<SideFlow, 'moments' | 'converged'>;
  return { ...steps, logFactors: flows.logFactors(side) };
}

async function run({ module, source, target, landmarks, cones }: FlowRequest): Promise<void> {
  try {
    await init({ module_or_path: module });
    const flows = recordFlows(source, target, landmarks, cones, {
      progress: (_stage, _sentence, share) => {
        post({ kind: 'progress', share });
      },
      relaxes: () => undefined,
      found: () => undefined,
      preview: () => undefined,
      wantsResult: () => false,
    });
    const both = [sideOf(flows, 0), sideOf(flows, 1)] as const;
    post({ kind: 'done', flows: both }, both.map(({ logFactors }) => logFactors.buffer).filter((buffer) => buffer instanceof ArrayBuffer));
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<FlowRequest>) => {
  void run(event.data);
});
