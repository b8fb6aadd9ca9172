/** The line at the bottom: what to do next, the progress of a run, and the buttons that end it. */
import type { VNode } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import { byId } from '../dom.ts';
import { hint } from '../messages.ts';
import { figure } from '../numbers.ts';
import { shownStyle } from '../store/compared.ts';
import type { Running } from '../store/job.ts';
import { wholePairs } from '../store/order.ts';
import { proposed } from '../store/proposal.ts';
import { isCurrent, shownResult } from '../store/staleness.ts';
import type { HeatMap, State, Style } from '../store/state.ts';
import { isHeatMap } from '../store/surfaces.ts';
import { asked, waitingCount } from '../store/waiting.ts';
import type { PartProps } from './actions.ts';
import { meshName } from './names.ts';
import { progressNumber, runningSentence } from './progress.ts';
import type { Probe } from './shell.ts';
import { largestStretch } from './verdict.ts';

function nextClick(state: State): string {
  const next = asked(state);
  return hint({
    meshes: state.meshes.filter((file) => file !== null).length,
    asked:
      next === null
        ? null
        : { pair: next.pair.number, mesh: meshName(state, next.side), isProposed: proposed(state) !== null },
    pairs: wholePairs(state).length,
    waiting: next === null ? 0 : waitingCount(state, next.side) - 1,
  });
}

function stretchWords(distortion: number): string {
  return `Here stretched up to ${largestStretch(distortion).toFixed(2)} times`;
}

/** A sentence of each heat map about a place, from its value there, or from those on both meshes. */
const PLACE: Readonly<Record<HeatMap, (value: number, onTarget: number) => string>> = {
  distortion: (value) => `${stretchWords(value)}: distortion ${figure(value)} (1: none)`,
  angles: (value) => `Angles here are distorted by ${figure(value)} (1: none)`,
  areas: (value) => `Areas here grow by the factor ${figure(value)}`,
  truth: (value) => `The true image is ${figure(value)} away, in units of the root of the area`,
  factor: (onSource, onTarget) => `Lengths here grow by ${figure(onSource)} on the source, ${figure(onTarget)} on the target`,
  curvature: (onSource, onTarget) => `Curvature here, in units of a sphere’s: ${figure(onSource)} on the source, ${figure(onTarget)} on the target`,
  'flat-curvature': (onSource, onTarget) => `Curvature here after the flow, in units of a sphere’s: ${figure(onSource)} on the source, ${figure(onTarget)} on the target`,
};

/** A sentence about the place under the mouse: the value of the shown heat map, or else how much the map stretches the place. */
function placeSentence(surface: Style['surface'], { distortion, heat }: Probe): string | null {
  if (heat !== null && isHeatMap(surface)) {
    const [value = 0, onTarget = 0] = heat;
    return PLACE[surface](value, onTarget);
  }
  return distortion === null ? null : stretchWords(distortion);
}

/** What the line says while nothing runs; empty where the hint says everything. */
function restSentence(state: State, probe: Probe | null): string {
  const here = probe === null || state.job.kind === 'busy' ? null : placeSentence(shownStyle(state).surface, probe);
  if (here !== null) {
    return here;
  }
  switch (state.job.kind) {
    case 'busy':
      return state.job.task.sentence;
    case 'error':
      return shownResult(state) === null ? 'No map was made.' : 'No new map was made; the last one is shown.';
    case 'done':
      return isCurrent(state) ? 'The map is done.' : '';
    case 'idle':
    case 'running':
      return state.ready ? '' : 'Loading…';
  }
}

/** Keeps the keyboard focus in the line when the button that had it is removed. */
function useKeptFocus(running: boolean, finishable: boolean): { readonly current: HTMLButtonElement | null } {
  const finish = useRef<HTMLButtonElement>(null);
  const before = useRef(running);
  useLayoutEffect(() => {
    const active = document.activeElement;
    const lost = active === document.body || active?.closest('[hidden]') !== null;
    if (lost && (before.current !== running || active === finish.current)) {
      (running ? byId('cancel') : document.getElementById('run'))?.focus();
    }
    before.current = running;
  }, [running, finishable]);
  return finish;
}

function RunButtons({ job, actions }: { readonly job: Running | null } & Pick<PartProps, 'actions'>): VNode {
  const finishable = job?.finish === 'possible';
  const finish = useKeptFocus(job !== null, finishable);
  return (
    <>
      <button
        ref={finish}
        type="button"
        id="finish"
        hidden={!finishable}
        title="Stop improving the map and show it: whole and certified, only less relaxed"
        onClick={actions.finish}
      >
        Finish now
      </button>
      <button type="button" id="cancel" hidden={job === null} onClick={actions.cancel}>
        Cancel
      </button>
    </>
  );
}

/** The share and the time in ms from which on the time that is left can be estimated. */
const GUESSED = { share: 0.15, elapsed: 1000 };

/** A sentence about the time that is left; empty before it can be estimated. */
function timeLeft(share: number, elapsed: number): string {
  if (share < GUESSED.share || elapsed < GUESSED.elapsed) {
    return '';
  }
  return `about ${Math.max(1, Math.round((elapsed * (1 - share)) / share / 1000))} s left`;
}

function Progress({ job }: { readonly job: Running }): VNode {
  const [start] = useState(() => performance.now());
  const share = job.progress?.share ?? 0;
  return (
    <>
      <span class="residual">{progressNumber(job)}</span>
      <span class="left quiet">{timeLeft(share, performance.now() - start)}</span>
      <progress max={1} value={share} aria-label="Progress of the map" />
    </>
  );
}

/** The button that ends the task that the page is busy with; it is shown only where the task takes a while. */
function LeaveButton({ leave }: { readonly leave: () => void }): VNode {
  return (
    <button
      type="button"
      id="leave-task"
      onClick={() => {
        leave();
        // The button is removed and loses the keyboard focus, which therefore goes to another one.
        document.getElementById('run')?.focus();
      }}
    >
      Cancel
    </button>
  );
}

/** The line. */
export function StatusLine({ state, actions, shell }: PartProps): VNode {
  const job = state.job.kind === 'running' ? state.job : null;
  const next = job !== null || !state.ready ? '' : nextClick(state);
  return (
    <footer id="status-line">
      <p id="hint" role="status" class="clipped" title={next} hidden={next === ''}>
        {next}
      </p>
      <div class="progress">
        <p id="status" role="status" class={job === null ? 'sentence quiet' : 'sentence'}>
          {job === null ? restSentence(state, shell.state.probe) : runningSentence(job)}
        </p>
        {job !== null && <Progress job={job} />}
        <RunButtons job={job} actions={actions} />
        {state.job.kind === 'busy' && <LeaveButton key={state.job.task.sentence} leave={actions.leaveTask} />}
      </div>
    </footer>
  );
}
