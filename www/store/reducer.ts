/** The one way to change the state: `update(state, event)`, without side effects. */
import type { Event } from './events.ts';
import { advanced, begun, ended, STARTED } from './job.ts';
import { withLandmarks, withMesh } from './loads.ts';
import {
  withAllTaken,
  withLabel,
  withPairDeleted,
  withPairs,
  withPick,
  withPickDropped,
  withSuggestions,
  withTargetsExchanged,
  withUndo,
} from './pairs.ts';
import type { Running } from './job.ts';
import type { State } from './state.ts';

/** A change of the run under way; without one, none. */
function withRun(state: State, change: (job: Running) => Running): State {
  return state.job.kind === 'running' ? { ...state, job: change(state.job) } : state;
}

/** The state after an event. */
export function update(state: State, event: Event): State {
  switch (event.kind) {
    case 'ready':
      return { ...state, ready: true, demos: event.demos };
    case 'task-begun':
      return { ...state, job: begun(state.job, event.task) };
    case 'task-ended':
      return { ...state, job: ended(state.job, event.task) };
    case 'mesh':
      return withMesh(state, event.side, event.file);
    case 'landmarks':
      return withLandmarks(state, event.file);
    case 'demo':
      return { ...state, demo: event.demo, history: [], error: null };
    case 'picked':
      return withPick(state, event.side, event.point);
    case 'pick-dropped':
      return withPickDropped(state);
    case 'suggested':
      return { ...state, suggestions: withSuggestions(state, event.side, event.suggestions) };
    case 'suggestions-taken':
      return withAllTaken(state, event.side);
    case 'pair-deleted':
      return withPairDeleted(state, event.index);
    case 'pair-labelled':
      return withLabel(state, event.index, event.label);
    case 'pairs-cleared':
      return { ...withPairs(state, []), pending: null, queue: [] };
    case 'targets-exchanged':
      return withTargetsExchanged(state, event.indices);
    case 'undo':
      return withUndo(state);
    case 'options':
      return { ...state, options: { ...state.options, ...event.options } };
    case 'style':
      return { ...state, style: { ...state.style, ...event.style } };
    case 'run-started':
      return { ...state, job: STARTED, findings: [], error: null, pending: null, queue: [] };
    case 'run-progress':
      return withRun(state, (job) => advanced(job, event.progress));
    case 'run-relaxes':
      return withRun(state, (job) => ({ ...job, energies: [...job.energies, []] }));
    case 'run-finishable':
      return withRun(state, (job) => ({ ...job, finish: 'possible' }));
    case 'run-finish':
      return withRun(state, (job) => ({ ...job, finish: 'asked' }));
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
      return { ...state, job: { kind: state.result === null ? 'idle' : 'done' } };
    case 'error':
      return { ...state, error: event.sentence };
    case 'error-closed':
      return { ...state, error: null };
  }
}
