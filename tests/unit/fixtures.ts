/** States and files for tests. */
import type { AnswerPicture } from '../../www/compute/match-messages.ts';
import type { RunOutput, SideOutput } from '../../www/compute/messages.ts';
import type { Pair, Suggestion, SurfacePoint } from '../../www/landmarks.ts';
import type { Candidate, Finding, MatchReport, ProofReport, Report } from '../../www/report.ts';
import { change } from '../../www/store/change.ts';
import type { Event } from '../../www/store/events.ts';
import type { AwaitedMap } from '../../www/store/awaited.ts';
import type { Running } from '../../www/store/job.ts';
import type { OpenedMap } from '../../www/store/opened.ts';
import type { Demo, Doubt, MeshFile, Result, State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { workOf } from '../../www/store/work.ts';
import type { LoadedMesh } from '../../www/wasm/page.js';

/** A mesh without anything in the core; `freed` counts how often its memory was freed. */
export function mesh(name: string, faceCount = 20): MeshFile & { readonly freed: () => number } {
  let freed = 0;
  const loaded = {
    free: () => {
      freed++;
    },
  } as unknown as LoadedMesh;
  const bytes = new TextEncoder().encode(name);
  return { name, bytes, mesh: loaded, vertexCount: 12, faceCount, turnedFaces: 0, look: 'none', repairs: '', freed: () => freed };
}

/** A pair whose number is its id, as on a page where no pair was deleted. */
export function pair(id: number, source: SurfacePoint | null, target: SurfacePoint | null, label = ''): Pair {
  return { id, number: id, points: [source, target], label, locked: false };
}

export function suggestion(point: number, letter: string): Suggestion {
  return { point, reason: 'tip', letter, partner: null };
}

export const FOUR: readonly Pair[] = [pair(1, 0, 10), pair(2, 1, 11), pair(3, 2, 12), pair(4, 3, 13)];
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
/** The same finding as a doubt of the page. */
export const DOUBT: Doubt = {
  ...SWAPPED,
  sentence: 'The targets of the pairs 1 and 2 look swapped: exchanged with each other they would fit the source. Exchange them.',
  ids: [1, 2],
};
const NOWHERE = { positions: new Float32Array(9) } as SideOutput;
export const OUTPUT = { report: '{}', base: null, distortion: new Float32Array(3), truth: new Float32Array(), sides: [NOWHERE, NOWHERE] as const, triangles: new Uint32Array([0, 1, 2]) } as RunOutput;
export const REPORT = { warnings: [], stopped_early: false } as unknown as Report;

/** Two meshes and four pairs, while the page is at rest. */
export const READY: State = {
  ...INITIAL,
  ready: true,
  meshes: [mesh('cat.off'), mesh('lion.off')],
  pairs: FOUR,
  named: ['cat.off', 'lion.off'],
  nextId: 5,
};
export const RUNNING: Running = { kind: 'running', inputs: workOf(READY), progress: null, finish: 'no', energies: [], preview: null };

/** A map that was made from them. */
export const RESULT: Result = { output: OUTPUT, report: REPORT, inputs: workOf(READY), opened: null };
export const DONE: State = { ...READY, job: { kind: 'done' }, result: RESULT };
export const REFUSAL: ProofReport = { verdict: 'refused', kind: 'hash', sentence: 'The map was made with another source.' };

/** A map file for meshes that are on no page. */
export const AWAITED: AwaitedMap = {
  name: 'map.conemap',
  bytes: new Uint8Array([1]),
  meshes: [
    { name: 'cow.off', checked: 'c0' },
    { name: null, checked: 'd0' },
  ],
};
/** A map of READY that was opened from a file. */
export const OPENED: OpenedMap = {
  name: 'map.conemap',
  isMirrored: false,
  output: OUTPUT,
  report: { ...REPORT, findings: [] },
  landmarks: {
    pairs: [
      [0, 10],
      [1, 11],
      [2, 12],
      [3, 13],
    ],
  },
  options: READY.options,
};

/** A candidate with these pairs, and a label for each. */
export function candidate(...pairs: readonly (readonly [number, number])[]): Candidate {
  return {
    pairs: pairs.map(([source, target]): [number, number] => [source, target]),
    labels: pairs.map((_, index) => `end ${index + 1}`),
    origins: pairs.map(() => 'tips'),
    score: 1,
    mean_log: 0.2,
    remoteness: 0.1,
    relief: 0.02,
    patch_fit: 0.2,
    agreement: 0.9,
    unmatched: [0, 0],
    difference: null,
  };
}

/** Two answers of a search that held the first two pairs of FOUR: the second answer exchanges two targets. */
export const MATCH: MatchReport = {
  verdict: { kind: 'doubtful', sentence: 'The landmarks are doubtful.', question: { source: 4, targets: [14, 15], rival: 1 }, places: [] },
  candidates: [candidate([0, 10], [1, 11], [4, 14], [5, 15]), candidate([0, 10], [1, 11], [4, 15], [5, 14], [6, 16])],
};

/** The pictures of their coarse maps: a corner of a cube and its image, the same for both. */
export const PICTURES: readonly AnswerPicture[] = MATCH.candidates.map(() => ({
  triangles: new Uint32Array([0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2]),
  places: [new Float32Array([-1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1]), new Float32Array([1, 1, 1, -1, 1, 1, 1, -1, 1, 1, 1, -1])],
}));

/** The state after these events, each of which is a step of its own. */
export function after(state: State, ...events: readonly Event[]): State {
  return events.reduce((present, event) => change(present, [event]), state);
}
