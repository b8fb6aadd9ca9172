/** The reducer: `update(state, event)` is the state after an event, without side effects and without recording steps. */
import type { Side } from '../landmarks.ts';
import { withPlane, withTwins } from './across.ts';
import type { Event } from './events.ts';
import { breakdownOf } from './breakdown.ts';
import { withCompared, withComparison } from './compared.ts';
import { earlierOf } from './comparison.ts';
import { pictureLeft, pictureOf } from './demo-picture.ts';
import { NO_HISTORY, redone, undone } from './history.ts';
import type { ProofReport } from '../report.ts';
import { advanced, begun, ended, started } from './job.ts';
import type { Running } from './job.ts';
import { withLandmarks, withMesh, withMirrored, withSwap } from './loads.ts';
import { withAllMirrored, withMirroredDrop, withMirroredLabel, withMirroredMove, withMirroredPick, withMirroredProposal } from './mirrored.ts';
import { withOpened } from './opened.ts';
import { doubtsOf } from './order.ts';
import {
  withLock,
  withPairAt,
  withPairDeleted,
  withPairsCleared,
  withSuggestions,
  withTargetsExchanged,
} from './pairs.ts';
import { withoutSide } from './refused.ts';
import { withReceived, withRestored } from './restore.ts';
import { withFindings } from './settle.ts';
import { withSideMarks } from './side-marks.ts';
import { withRadius, withSettled } from './soft.ts';
import { withFound, withSearch, withSearched, withTaken } from './search.ts';
import { isKnown } from './surfaces.ts';
import type { Result, State, Style } from './state.ts';
import { shownResult } from './staleness.ts';
import type { Axis, MeshFile } from './work.ts';
import { workOf } from './work.ts';

/** Changes the run that goes on; leaves the state alone where none does. */
function withRun(state: State, change: (job: Running) => Running): State {
  return state.job.kind === 'running' ? { ...state, job: change(state.job) } : state;
}

/** An object with some fields replaced; the same object where none of them differs. */
function patched<T extends object>(object: T, patch: Partial<T>): T {
  const isOther = (Object.keys(patch) as (keyof T)[]).some((key) => patch[key] !== object[key]);
  return isOther ? { ...object, ...patch } : object;
}

function withUi(state: State, patch: Partial<State['ui']>): State {
  return patched(state, { ui: patched(state.ui, patch) });
}

function withStyle(state: State, patch: Partial<Style>): State {
  return withUi(state, { style: patched(state.ui.style, patch) });
}

/** The state without the refused mesh of a side. */
function withoutRefused(state: State, side: Side): State {
  return patched(state, { refused: withoutSide(state.refused, side) });
}

/** Whether an id belongs to a pair; `null`, which means no pair, is always accepted. */
function isPair({ pairs }: State, id: number | null): boolean {
  return id === null || pairs.some((pair) => pair.id === id);
}

/** The state with another step's work. A mesh that stays keeps the axis that points up. */
function withStep(state: State, step: ReturnType<typeof undone>): State {
  if (step === null) {
    return state;
  }
  const { work, history } = step;
  const up = (side: Side): Axis => (work.meshes[side] === state.meshes[side] ? state : work).up[side];
  const stands = work.meshes === state.meshes ? state.up : ([up(0), up(1)] as const);
  return { ...state, ...work, up: stands, history, toast: null, error: null };
}

/** The state with an error, which the page shows. */
function withError(state: State, { sentence, failure }: Extract<Event, { readonly kind: 'error' | 'run-failed' }>): State {
  return { ...state, error: sentence, breakdown: breakdownOf(state.job, sentence, failure) };
}

/** The state with a new map. Where the surfaces are plain, or show what this map does not have, the pattern is chosen. */
function withResult(state: State, result: Result): State {
  const earlier = state.result === null ? state.earlier : earlierOf(state.result);
  const done = { ...state, result, earlier, mapless: null };
  const { surface } = state.ui.style;
  const isShown = surface !== 'shaded' && isKnown(result, surface);
  return isShown ? done : withStyle(done, { surface: 'pattern' });
}

/** The state after a mesh has come: its own colours are shown where no other surface was chosen. */
function withOwnLook(state: State, { look }: MeshFile): State {
  return look === 'colours' && state.ui.style.surface === 'shaded' ? withStyle(state, { surface: 'look' }) : state;
}

/** The state after a proof; an answer about an earlier map is ignored. */
function withProof(state: State, of: Result, answer: ProofReport | null): State {
  return state.proof?.of === of ? { ...state, proof: answer === null ? null : { of, answer } } : state;
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
      return withOwnLook(withoutRefused(withMesh(withStyle(state, pictureLeft(state)), event.side, event.file), event.side), event.file);
    case 'mirrored':
      return withMirrored(state, event.file, event.points);
    case 'swap-meshes':
      return withSwap(state);
    case 'landmarks':
      return withLandmarks(state, event.file);
    case 'side-marks':
      return withSideMarks(state, event.side, event.points);
    case 'demo':
      return { ...withStyle(state, pictureOf(event.demo)), demo: event.demo, error: null };
    case 'point-picked':
      return withMirroredPick(state, event.side, event.point, event.across ?? null);
    case 'point-moved':
      return withMirroredMove(state, event.id, event.side, event.point, event.across ?? null);
    case 'pick-dropped':
      return withMirroredDrop(state);
    case 'proposal-accepted':
      return withMirroredProposal(state, event.across ?? null);
    case 'suggestions-taken':
      return withAllMirrored(state, event.side);
    case 'pair-deleted':
      return withPairDeleted(state, event.id);
    case 'pair-labelled':
      return withMirroredLabel(state, event.id, event.label);
    case 'pair-locked':
      return withLock(state, event.id, event.locked);
    case 'pair-softened':
      return withRadius(state, event.id, event.radius);
    case 'pair-moved':
      return withPairAt(state, event.id, event.to);
    case 'pairs-cleared':
      return withPairsCleared(state);
    case 'targets-exchanged':
      return withTargetsExchanged(state, event.ids);
    case 'options':
      return patched(state, { options: patched(state.options, event.options) });
    case 'restored':
      return patched(withRestored(state, event, event.ui), { refused: null, mapless: event.hadMap ? event.work.meshes : null });
    case 'received':
      return patched(withReceived(state, event.work, event.ui), { refused: null });
    case 'undo':
      return withStep(state, undone(state.history, workOf(state)));
    case 'redo':
      return withStep(state, redone(state.history, workOf(state)));
    case 'history-begun':
      return patched(state, { history: NO_HISTORY, toast: null });
    case 'pair-selected':
      return isPair(state, event.id) ? withUi(state, { selected: event.id }) : state;
    case 'pair-hovered':
      return isPair(state, event.id) ? withUi(state, { hovered: event.id }) : state;
    case 'ui':
      return withUi(state, event.ui);
    case 'style':
      return withStyle(state, event.style);
    case 'up':
      return patched(state, { up: event.side === 0 ? [event.axis, state.up[1]] : [state.up[0], event.axis] });
    case 'camera-moved': {
      const [source, target] = state.ui.cameras;
      return withUi(state, { cameras: event.side === 0 ? [event.camera, target] : [source, event.camera] });
    }
    case 'suggested':
      return { ...state, suggestions: withSuggestions(state, event.side, event.suggestions) };
    case 'proposed':
      return { ...state, proposal: event.proposal };
    case 'proposal-dropped':
      return patched(state, { proposal: null });
    case 'left-right':
      return patched(state, { leftRight: patched(state.leftRight, { isOn: event.isOn }) });
    case 'plane':
      return withPlane(state, event.side, event.plane);
    case 'twins':
      return event.twins.reduce((present, [a, b]) => withTwins(present, a, b), state);
    case 'search-begun':
      return withSearch(state);
    case 'search-progress':
      return withSearched(state, { share: event.share });
    case 'search-preview':
      return withSearched(state, { preview: event.places, ghosts: event.pairs });
    case 'search-done':
      return withFound(state, event.report, event.pictures);
    case 'candidate-taken':
      return withTaken(state, event.candidate);
    case 'search-closed':
      return patched(state, { matching: null });
    case 'comparison-begun':
      return withComparison(state, event.which);
    case 'comparison':
      return withCompared(state, event.which, event.progress);
    case 'flattening':
      return { ...state, flattening: event.flattening };
    case 'texture-picture':
      return withStyle({ ...state, texturePicture: event.picture, error: null }, { surface: 'picture' });
    case 'comparison-closed':
      return patched(state, { comparison: null });
    case 'run-started':
      return {
        ...state,
        matching: state.matching?.kind === 'searching' ? null : state.matching,
        job: started(workOf(state)),
        found: null,
        findings: [],
        error: null,
      };
    case 'run-progress':
      return withRun(state, (job) => advanced(job, event.progress));
    case 'run-relaxes':
      return withRun(state, (job) => ({ ...job, energies: [...job.energies, []] }));
    case 'run-preview':
      return withRun(state, (job) => ({ ...job, preview: event.places }));
    case 'run-finishable':
      return withRun(state, (job) => ({ ...job, finish: 'possible' }));
    case 'run-finish':
      return withRun(state, (job) => ({ ...job, finish: 'asked' }));
    case 'run-found':
      return state.job.kind === 'running'
        ? withFindings({ ...state, found: { doubts: doubtsOf(event.findings, state.job.inputs), inputs: state.job.inputs } })
        : state;
    case 'run-done': {
      if (state.job.kind !== 'running') {
        return state;
      }
      const { output, report } = event;
      const settled = withSettled(state, state.job.inputs, report.settled ?? []);
      return withResult({ ...settled.state, job: { kind: 'done' } }, { output, report, inputs: settled.inputs, opened: null });
    }
    case 'map-opened': {
      const { state: settled, result } = withOpened(state, event.map);
      return withFindings(withResult(settled, result));
    }
    case 'map-awaited':
      return patched(state, { awaited: event.map });
    case 'run-failed':
      return { ...withError(state, event), job: { kind: 'error' } };
    case 'proof-begun':
      return { ...state, proof: { of: event.of, answer: null } };
    case 'proof-done':
      return withProof(state, event.of, event.answer);
    case 'run-cancelled':
      return { ...state, job: { kind: shownResult(state) === null ? 'idle' : 'done' } };
    case 'toast':
      return { ...state, toast: { sentence: event.sentence, undo: event.undo } };
    case 'toast-closed':
      return patched(state, { toast: null });
    case 'receiving':
      return { ...state, receiving: event.receiving };
    case 'examined':
      return { ...state, examined: event.side === 0 ? [event.examined, state.examined[1]] : [state.examined[0], event.examined] };
    case 'refused':
      return patched(state, { refused: event.refused });
    case 'refused-closed':
      return withoutRefused(state, event.side);
    case 'outdated':
      return { ...state, isOutdated: true };
    case 'undrawn':
      return patched(state, { undrawn: event.sentence });
    case 'offered':
      return { ...state, offer: event.offer };
    case 'offer-closed':
      return patched(state, { offer: null });
    case 'error':
      return withError(state, event);
    case 'error-closed':
      return patched(state, { error: null });
  }
}
