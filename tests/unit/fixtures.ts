/** States and files to test with. */
import type { RunOutput } from '../../www/compute/messages.ts';
import type { Pair, Suggestion, SurfacePoint } from '../../www/landmarks.ts';
import type { Finding, Report } from '../../www/report.ts';
import type { Event } from '../../www/store/events.ts';
import type { Running } from '../../www/store/job.ts';
import { update } from '../../www/store/reducer.ts';
import type { Demo, MeshFile, State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import type { LoadedMesh } from '../../www/wasm/conemap.js';

/** A mesh that the core knows nothing of; `freed` counts how often it was given back. */
export function mesh(name: string): MeshFile & { readonly freed: () => number } {
  let freed = 0;
  const loaded = {
    free: () => {
      freed++;
    },
  } as unknown as LoadedMesh;
  const bytes = new TextEncoder().encode(name);
  return { name, bytes, mesh: loaded, vertexCount: 12, faceCount: 20, turnedFaces: 0, freed: () => freed };
}

export function pair(source: SurfacePoint, target: SurfacePoint, label = ''): Pair {
  return { points: [source, target], label };
}

export function suggestion(point: number, letter: string): Suggestion {
  return { point, reason: 'tip', letter, partner: null };
}

export const FOUR: readonly Pair[] = [pair(0, 10), pair(1, 11), pair(2, 12), pair(3, 13)];
export const DEMO: Demo = { id: 'ball', title: 'Ball', sentence: 'A ball' };
export const SWAPPED: Finding = {
  kind: 'swapped',
  pairs: [0, 1],
  repair: 'swap',
  sentence: 'Two pairs look swapped.',
  agreement: -1,
  misfit: [0.5, 0.1],
  distance: null,
  near: null,
  side: null,
  vertices: [],
};
export const OUTPUT = { report: '{}' } as RunOutput;
export const REPORT = { warnings: [] } as unknown as Report;
export const RUNNING: Running = { kind: 'running', progress: null, finish: 'no', energies: [] };

/** Two meshes, four pairs, nothing under way. */
export const READY: State = {
  ...INITIAL,
  ready: true,
  meshes: [mesh('cat.off'), mesh('lion.off')],
  pairs: FOUR,
  named: ['cat.off', 'lion.off'],
};

/** A map was made from them. */
export const DONE: State = {
  ...READY,
  job: { kind: 'done' },
  result: { output: OUTPUT, report: REPORT, pairs: FOUR, options: READY.options },
};

export function after(state: State, ...events: readonly Event[]): State {
  return events.reduce(update, state);
}
