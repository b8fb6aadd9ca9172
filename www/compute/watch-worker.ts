/** The worker that computes parts of the method again: it answers one request, then is ended. */
import init, { recordCarriedSimplification, recordFlows, recordSimplifications, runOtherMap } from '../wasm/core.js';
import type { RecordedFlows, Simplifications as RecordedSimplifications } from '../wasm/core.js';
import { failureOf } from './messages.ts';
import { progressListener } from './progress-listener.ts';
import { viewBuffers } from './view-buffers.ts';
import type { Flows, OtherOutput, SideFlow, Simplification, Simplifications, Watchable, Watched, WatchMessage, WatchRequest } from './watch-messages.ts';

declare const self: DedicatedWorkerGlobalScope;

const LISTENER = progressListener((share) => {
  post({ kind: 'progress', share });
});

function post(message: WatchMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

function flowOf(flows: RecordedFlows, side: number): SideFlow {
  const steps = JSON.parse(flows.steps(side)) as Pick<SideFlow, 'moments' | 'converged' | 'stops'>;
  return { ...steps, logFactors: flows.logFactors(side), radii: flows.radii(side), curvatures: [flows.curvatures(side, 0), flows.curvatures(side, 1)], packedStops: flows.packedStops(side) };
}

function simplificationOf(stages: RecordedSimplifications, side: number): Simplification {
  return { positions: stages.positions(side), triangles: stages.triangles(side), counts: stages.counts(side), collapses: stages.collapses(side) };
}

function flowsOf({ source, target, landmarks, cones, scheme }: WatchRequest): Flows {
  if (scheme === null) {
    throw new Error('no conformal structure is named');
  }
  const flows = recordFlows(source, target, landmarks, cones, scheme, LISTENER);
  return [flowOf(flows, 0), flowOf(flows, 1)];
}

function simplificationsOf({ source, target, landmarks, carried }: WatchRequest): Simplifications {
  const stages =
    carried === null
      ? recordSimplifications(source, target, landmarks, LISTENER)
      : recordCarriedSimplification(carried.map, source, target, landmarks, carried.from, LISTENER);
  return [simplificationOf(stages, 0), simplificationOf(stages, 1)];
}

function otherMapOf({ source, target, landmarks, other }: WatchRequest): OtherOutput {
  if (other === null) {
    throw new Error('no other map is named');
  }
  const { which, options, demo } = other;
  const map = runOtherMap(source, target, landmarks, JSON.stringify(options), which, LISTENER, demo);
  const { sides, uvs, distortion, truth, triangles, report } = viewBuffers(map);
  map.free();
  return { sides, uvs, distortion, truth, triangles, report };
}

function answerTo(request: WatchRequest): Watched[Watchable] {
  switch (request.wanted) {
    case 'flows':
      return flowsOf(request);
    case 'simplifications':
      return simplificationsOf(request);
    case 'other-map':
      return otherMapOf(request);
  }
}

/** The arrays in an answer, to be transferred without a copy. */
function arraysIn(value: unknown): readonly ArrayBufferView[] {
  if (ArrayBuffer.isView(value)) {
    return [value];
  }
  return typeof value === 'object' && value !== null ? Object.values(value).flatMap(arraysIn) : [];
}

async function run(request: WatchRequest): Promise<void> {
  try {
    await init({ module_or_path: request.module });
    const answer = answerTo(request);
    const buffers = new Set(arraysIn(answer).map(({ buffer }) => buffer));
    post({ kind: 'done', answer }, [...buffers].filter((buffer) => buffer instanceof ArrayBuffer));
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<WatchRequest>) => {
  void run(event.data);
});
