/** One state and one way to change it: `update(state, event)`, without side effects. */
import type { Progress, RunOutput } from './compute/messages.ts';
import { pointTaken } from './messages.ts';
import type { Finding, Report, RunOptions } from './report.ts';
import type { LoadedMesh } from './wasm/conemap.js';

/** 0 the source, 1 the target. */
export type Side = 0 | 1;
export const SIDES: readonly [0, 1] = [0, 1];

/** A point of a surface: a vertex of the file, or a place in a face. */
export type SurfacePoint =
  | number
  | { readonly face: number; readonly barycentric: readonly [number, number, number] };

export interface Pair {
  readonly points: readonly [SurfacePoint, SurfacePoint];
  readonly label: string;
}

/** A place of one mesh that is worth a landmark. */
export interface Suggestion {
  readonly point: number;
  /** The end of a limb, or far from all landmarks. */
  readonly reason: 'tip' | 'far';
  /** Its name on the page. */
  readonly letter: string;
  /** The letter of the suggestion that looks alike, as left and right do. */
  readonly partner: string | null;
}

/** A mesh with the bytes it came from; the bytes go to the worker. */
export interface MeshFile {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly mesh: LoadedMesh;
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly turnedFaces: number;
}

/** A landmark file as the core reads it. */
export interface LandmarkFile {
  readonly source?: string;
  readonly target?: string;
  readonly pairs: readonly (readonly [SurfacePoint, SurfacePoint])[];
  readonly labels?: readonly string[];
  readonly ground_truth?: string;
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

/** A run under way. */
export interface Running {
  readonly kind: 'running';
  readonly progress: Progress | null;
  /** Whether it can be asked to finish, and whether it was. */
  readonly finish: 'no' | 'possible' | 'asked';
  /** Falling energies of each relaxation, the first first. */
  readonly energies: readonly (readonly number[])[];
}

const STARTED: Running = { kind: 'running', progress: null, finish: 'no', energies: [] };

/** Where the map is. */
export type Job =
  | { readonly kind: 'idle' }
  | Running
  | { readonly kind: 'done' }
  | { readonly kind: 'error' };

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
  /** What the page is busy with besides a run, as a sentence. */
  readonly busy: string | null;
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
  busy: null,
};

export type Event =
  | { readonly kind: 'ready'; readonly demos: readonly Demo[] }
  | { readonly kind: 'busy'; readonly sentence: string | null }
  | { readonly kind: 'mesh'; readonly side: Side; readonly file: MeshFile }
  | { readonly kind: 'landmarks'; readonly file: LandmarkFile }
  | { readonly kind: 'demo'; readonly demo: Demo }
  | { readonly kind: 'picked'; readonly side: Side; readonly point: SurfacePoint }
  | { readonly kind: 'pick-dropped' }
  | { readonly kind: 'suggested'; readonly side: Side; readonly suggestions: readonly Suggestion[] }
  | { readonly kind: 'suggestions-taken'; readonly side: Side }
  | { readonly kind: 'pair-deleted'; readonly index: number }
  | { readonly kind: 'pair-labelled'; readonly index: number; readonly label: string }
  | { readonly kind: 'pairs-cleared' }
  | { readonly kind: 'targets-exchanged'; readonly indices: readonly number[] }
  | { readonly kind: 'undo' }
  | { readonly kind: 'options'; readonly options: Partial<RunOptions> }
  | { readonly kind: 'style'; readonly style: Partial<Style> }
  | { readonly kind: 'run-started' }
  | { readonly kind: 'run-progress'; readonly progress: Progress }
  | { readonly kind: 'run-relaxes' }
  | { readonly kind: 'run-finishable' }
  | { readonly kind: 'run-finish' }
  | { readonly kind: 'run-found'; readonly findings: readonly Finding[] }
  | { readonly kind: 'run-done'; readonly output: RunOutput; readonly report: Report }
  | { readonly kind: 'run-failed'; readonly sentence: string }
  | { readonly kind: 'run-cancelled' }
  | { readonly kind: 'error'; readonly sentence: string }
  | { readonly kind: 'error-closed' };

/** The least number of pairs that a map needs. */
export const MIN_PAIRS = 4;
const MAX_HISTORY = 200;

/** The file's name without folders. */
export function baseName(path: string): string {
  return path.slice(Math.max(path.lastIndexOf('/'), path.lastIndexOf('\\')) + 1);
}

/** Whether a run can start. */
export function canRun(state: State): boolean {
  return (
    state.ready &&
    state.job.kind !== 'running' &&
    state.meshes[0] !== null &&
    state.meshes[1] !== null &&
    state.pairs.length >= MIN_PAIRS
  );
}

/** Whether the shown result was made from other landmarks or options than those on the page; labels do not matter. */
export function isStale(state: State): boolean {
  const { result, pairs } = state;
  return (
    result !== null &&
    (result.options.method !== state.options.method ||
      result.options.base !== state.options.base ||
      result.options.cones !== state.options.cones ||
      result.options.class !== state.options.class ||
      result.options.ownCones !== state.options.ownCones ||
      result.pairs.length !== pairs.length ||
      result.pairs.some((pair, index) => pair.points !== pairs[index]?.points))
  );
}

/** Points of one side in pair order; the pending pair last, `null` where it is not picked yet. */
export function pointsOf(state: State, side: Side): (SurfacePoint | null)[] {
  const points: (SurfacePoint | null)[] = state.pairs.map((pair) => pair.points[side]);
  if (state.pending !== null) {
    points.push(state.pending.side === side ? state.pending.point : null);
  }
  return points;
}

/** The landmark file of the state. */
export function landmarkFileOf(state: State): LandmarkFile {
  const [source, target] = state.meshes;
  return {
    ...(source === null ? {} : { source: source.name }),
    ...(target === null ? {} : { target: target.name }),
    pairs: state.pairs.map((pair) => pair.points),
    ...(state.pairs.some((pair) => pair.label !== '')
      ? { labels: state.pairs.map((pair) => pair.label) }
      : {}),
    ...(state.groundTruth === null ? {} : { ground_truth: state.groundTruth }),
  };
}

function withPairs(state: State, pairs: readonly Pair[]): State {
  return { ...state, pairs, findings: [], history: [...state.history, state.pairs].slice(-MAX_HISTORY) };
}

function withMesh(state: State, side: Side, file: MeshFile): State {
  const meshes: [MeshFile | null, MeshFile | null] = [...state.meshes];
  const first = meshes[side] === null;
  meshes[side] = file;
  const keeps = first || state.named[side] === file.name;
  return {
    ...state,
    meshes,
    demo: null,
    pairs: keeps ? state.pairs : [],
    named: keeps ? state.named : [null, null],
    groundTruth: keeps ? state.groundTruth : null,
    pending: null,
    queue: [],
    suggestions: withSuggestions(state, side, []),
    history: [],
    result: null,
    findings: [],
    job: state.job.kind === 'running' ? state.job : { kind: 'idle' },
    style: { ...state.style, surface: 'shaded' },
  };
}

function withLandmarks(state: State, file: LandmarkFile): State {
  const pairs = file.pairs.map((points, index) => ({ points, label: file.labels?.[index] ?? '' }));
  return {
    ...withPairs(state, pairs),
    pending: null,
    queue: [],
    named: [
      file.source === undefined ? null : baseName(file.source),
      file.target === undefined ? null : baseName(file.target),
    ],
    groundTruth: file.ground_truth ?? null,
  };
}

function withSuggestions(state: State, side: Side, suggestions: readonly Suggestion[]): State['suggestions'] {
  return side === 0 ? [suggestions, state.suggestions[1]] : [state.suggestions[0], suggestions];
}

/** A point of one side is picked: half a pair, or the other half of one. */
function withPick(state: State, side: Side, point: SurfacePoint): State {
  const { pending } = state;
  const isSame = (other: SurfacePoint): boolean => JSON.stringify(other) === JSON.stringify(point);
  const pair = state.pairs.findIndex(({ points }) => isSame(points[side]));
  if (pair >= 0) {
    return { ...state, error: pointTaken(side, pair + 1) };
  }
  const left = state.suggestions[side].filter((suggestion) => suggestion.point !== point);
  const taken = left.length < state.suggestions[side].length;
  const suggestions = taken ? withSuggestions(state, side, left) : state.suggestions;
  if (pending === null || pending.side === side) {
    return { ...state, suggestions, pending: { side, point }, error: null };
  }
  const points: readonly [SurfacePoint, SurfacePoint] = side === 1 ? [pending.point, point] : [point, pending.point];
  return {
    ...withPairs(state, [...state.pairs, { points, label: '' }]),
    suggestions,
    error: null,
    ...nextInQueue(state, pending.side),
  };
}

/** The next point of a side that waits for its partner. */
function nextInQueue(state: State, side: Side): Pick<State, 'pending' | 'queue'> {
  const [point, ...queue] = state.queue;
  return { pending: point === undefined ? null : { side, point }, queue };
}

/** All suggestions of a side, the first one to be paired now. */
function withAllTaken(state: State, side: Side): State {
  const points = state.suggestions[side].map((suggestion) => suggestion.point);
  const waiting = state.pending?.side === side ? [state.pending.point, ...state.queue] : [];
  const queued = { ...state, queue: [...waiting, ...points] };
  return { ...queued, suggestions: withSuggestions(state, side, []), ...nextInQueue(queued, side) };
}

/** Two pairs with each other's target. */
function withTargetsExchanged(state: State, indices: readonly number[]): State {
  const [a, b] = indices.map((index) => state.pairs[index]);
  if (a === undefined || b === undefined) {
    return state;
  }
  const given = (pair: Pair, other: Pair): Pair => ({ ...pair, points: [pair.points[0], other.points[1]] });
  return withPairs(
    state,
    state.pairs.map((pair) => (pair === a ? given(a, b) : pair === b ? given(b, a) : pair)),
  );
}

/** A run after a report of its progress. */
function advanced(job: Running, progress: Progress): Running {
  const { energy, stage } = progress;
  // After the relaxation there is nothing left to shorten.
  const finish = stage === 'certificate' && job.finish === 'possible' ? 'no' : job.finish;
  const present = job.energies.at(-1) ?? [];
  const falls = stage === 'relaxation' && energy !== null && energy < (present.at(-1) ?? Infinity);
  return { ...job, progress, finish, energies: falls ? [...job.energies.slice(0, -1), [...present, energy]] : job.energies };
}

/** The state after an event. */
export function update(state: State, event: Event): State {
  switch (event.kind) {
    case 'ready':
      return { ...state, ready: true, demos: event.demos };
    case 'busy':
      return { ...state, busy: event.sentence };
    case 'mesh':
      return withMesh(state, event.side, event.file);
    case 'landmarks':
      return withLandmarks(state, event.file);
    case 'demo':
      return { ...state, demo: event.demo, history: [], error: null };
    case 'picked':
      return withPick(state, event.side, event.point);
    case 'pick-dropped':
      return state.pending === null ? state : { ...state, ...nextInQueue(state, state.pending.side) };
    case 'suggested':
      return { ...state, suggestions: withSuggestions(state, event.side, event.suggestions) };
    case 'suggestions-taken':
      return withAllTaken(state, event.side);
    case 'pair-deleted':
      return withPairs(
        state,
        state.pairs.filter((_, index) => index !== event.index),
      );
    case 'pair-labelled':
      return {
        ...state,
        pairs: state.pairs.map((pair, index) =>
          index === event.index ? { ...pair, label: event.label } : pair,
        ),
      };
    case 'pairs-cleared':
      return { ...withPairs(state, []), pending: null, queue: [] };
    case 'targets-exchanged':
      return withTargetsExchanged(state, event.indices);
    case 'undo': {
      if (state.pending !== null) {
        return { ...state, pending: null, queue: [] };
      }
      const last = state.history.at(-1);
      return last === undefined ? state : { ...state, pairs: last, findings: [], history: state.history.slice(0, -1) };
    }
    case 'options':
      return { ...state, options: { ...state.options, ...event.options } };
    case 'style':
      return { ...state, style: { ...state.style, ...event.style } };
    case 'run-started':
      return { ...state, job: STARTED, findings: [], error: null, pending: null, queue: [] };
    case 'run-progress':
      return state.job.kind === 'running' ? { ...state, job: advanced(state.job, event.progress) } : state;
    case 'run-relaxes':
      return state.job.kind === 'running'
        ? { ...state, job: { ...state.job, energies: [...state.job.energies, []] } }
        : state;
    case 'run-finishable':
      return state.job.kind === 'running' ? { ...state, job: { ...state.job, finish: 'possible' } } : state;
    case 'run-finish':
      return state.job.kind === 'running' ? { ...state, job: { ...state.job, finish: 'asked' } } : state;
    case 'run-found':
      return { ...state, findings: event.findings };
    case 'run-done':
      return {
        ...state,
        job: { kind: 'done' },
        result: { output: event.output, report: event.report, pairs: state.pairs, options: state.options },
        style: { ...state.style, surface: 'checkerboard' },
      };
    case 'run-failed':
      return { ...state, job: { kind: 'error' }, error: event.sentence };
    case 'run-cancelled':
      return { ...state, job: state.result === null ? { kind: 'idle' } : { kind: 'done' } };
    case 'error':
      return { ...state, error: event.sentence };
    case 'error-closed':
      return { ...state, error: null };
  }
}
