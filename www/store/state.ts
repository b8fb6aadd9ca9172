/** The state of the page: everything that it shows follows from it. */
import type { RunOutput } from '../compute/messages.ts';
import type { RunOptions } from '../report.ts';
import type { Pair, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import type { Finding, Report } from '../report.ts';
import type { LoadedMesh } from '../wasm/conemap.js';
import type { Job } from './job.ts';

/** A mesh with the bytes it came from; the bytes go to the worker. */
export interface MeshFile {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly mesh: LoadedMesh;
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly turnedFaces: number;
}

export interface Demo {
  readonly id: string;
  readonly title: string;
  readonly sentence: string;
}

export interface Style {
  readonly surface: 'shaded' | 'checkerboard' | 'colours' | 'distortion';
  readonly patchLines: boolean;
  readonly cones: boolean;
  readonly markers: boolean;
}

export interface Result {
  readonly output: RunOutput;
  readonly report: Report;
  /** The landmarks and options it was made from, to tell whether it is still current. */
  readonly pairs: readonly Pair[];
  readonly options: RunOptions;
}

export interface State {
  readonly ready: boolean;
  readonly demos: readonly Demo[];
  readonly demo: Demo | null;
  readonly meshes: readonly [MeshFile | null, MeshFile | null];
  readonly pairs: readonly Pair[];
  /** Names the landmark file gave to the meshes, without folders. */
  readonly named: readonly [string | null, string | null];
  readonly groundTruth: string | null;
  /** A point picked on one side that waits for its partner. */
  readonly pending: { readonly side: Side; readonly point: SurfacePoint } | null;
  /** Points of the pending one's side whose turn comes after it. */
  readonly queue: readonly SurfacePoint[];
  /** Suggested landmarks by side. */
  readonly suggestions: readonly [readonly Suggestion[], readonly Suggestion[]];
  /** Earlier lists of pairs, latest last. */
  readonly history: readonly (readonly Pair[])[];
  readonly options: RunOptions;
  readonly style: Style;
  readonly job: Job;
  readonly result: Result | null;
  /** Doubts about the present pairs, from the last run. */
  readonly findings: readonly Finding[];
  readonly error: string | null;
}

export const INITIAL: State = {
  ready: false,
  demos: [],
  demo: null,
  meshes: [null, null],
  pairs: [],
  named: [null, null],
  groundTruth: null,
  pending: null,
  queue: [],
  suggestions: [[], []],
  history: [],
  options: { method: 'relaxed', base: 'joint', cones: 'base-domain', class: 'best', ownCones: null },
  style: { surface: 'shaded', patchLines: true, cones: true, markers: true },
  job: { kind: 'idle' },
  result: null,
  findings: [],
  error: null,
};
