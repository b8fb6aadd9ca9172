/** Everything that can happen to the state. */
import type { Progress, RunOutput } from '../compute/messages.ts';
import type { RunOptions } from '../report.ts';
import type { LandmarkFile, Side, Suggestion, SurfacePoint } from '../landmarks.ts';
import type { Finding, Report } from '../report.ts';
import type { Task } from './job.ts';
import type { Demo, MeshFile, Style } from './state.ts';

export type Event =
  | { readonly kind: 'ready'; readonly demos: readonly Demo[] }
  | { readonly kind: 'task-begun'; readonly task: Task }
  | { readonly kind: 'task-ended'; readonly task: Task }
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
