/** Start, progress and cancel; the page's errors. */
import { hint } from '../messages.ts';
import type { Progress } from '../compute/messages.ts';
import { byId, button, make } from '../dom.ts';
import { figure } from '../numbers.ts';
import type { Running } from '../store/job.ts';
import { wholePairs } from '../store/order.ts';
import { canRun, MIN_PAIRS } from '../store/readiness.ts';
import { isCurrent, shownResult } from '../store/staleness.ts';
import { asked, waitingCount } from '../store/waiting.ts';
import type { State } from '../store/state.ts';
import { EnergyCurve } from './energy.ts';
import type { Actions, Panel } from './panel.ts';

function selectOf<T extends string>(
  label: string,
  choices: readonly (readonly [T, string])[],
  onChange: (value: T) => void,
): { readonly row: HTMLElement; readonly select: HTMLSelectElement } {
  const select = make('select', {}, ...choices.map(([value, text]) => make('option', { value }, text)));
  select.addEventListener('change', () => {
    const choice = choices[select.selectedIndex];
    if (choice !== undefined) {
      onChange(choice[0]);
    }
  });
  return { row: make('label', { class: 'field' }, make('span', {}, label), select), select };
}

/** What the run panel says when nothing runs. */
function idleSentence(state: State): string {
  if (state.job.kind === 'busy') {
    return state.job.task.sentence;
  }
  if (!state.ready) {
    return 'Loading…';
  }
  if (state.meshes.includes(null)) {
    return 'Choose a source and a target mesh.';
  }
  const pairs = wholePairs(state).length;
  if (pairs < MIN_PAIRS) {
    return `${pairs} of at least ${MIN_PAIRS} landmark pairs.`;
  }
  if (shownResult(state) === null) {
    return `Ready with ${pairs} landmark pairs.`;
  }
  return isCurrent(state) ? 'The map is done.' : 'The landmarks or options have changed since the map shown.';
}

/** What a run does. */
function runningSentence({ progress, finish }: Running): string {
  const stage = progress === null ? 'Starting' : progress.sentence;
  return finish === 'asked' ? `Finishing with the best map so far: ${stage.toLowerCase()}…` : `${stage}…`;
}

/** The number that a run brings down, in words. */
function progressNumber({ energy, residual, stage }: Progress, relaxations: number): string {
  if (energy !== null) {
    const isFinal = stage === 'relaxation';
    const which = isFinal ? 'Energy' : 'Energy of the map being tried';
    return `${which} ${energy.toFixed(3)} (4 is an isometry)${isFinal ? `, level ${relaxations}` : ''}`;
  }
  return residual === null ? '' : `Residual ${figure(residual)}`;
}

/** Makes the panel. */
export function runPanel(actions: Actions): Panel {
  const root = byId('run-panel');
  const run = button('Compute the map', actions.run, { id: 'run', class: 'primary' });
  const finish = button('Finish now', actions.finish, {
    id: 'finish',
    hidden: true,
    title: 'Stop improving the map and show it: whole and certified, only less relaxed',
  });
  const cancel = button('Cancel', actions.cancel, { id: 'cancel', hidden: true });
  const bar = make('progress', { max: 1, value: 0, 'aria-label': 'Progress of the map', hidden: true });
  const status = make('p', { id: 'status', role: 'status' });
  const about = make('p', { class: 'quiet' });
  const residual = make('p', { class: 'quiet residual' });
  const curve = new EnergyCurve();
  const method = selectOf(
    'Method',
    [
      ['relaxed', 'Relaxed, certified'],
      ['thesis', 'Patch by patch'],
    ] as const,
    (value) => {
      actions.dispatch({ kind: 'options', options: { method: value } });
    },
  );
  const base = selectOf(
    'Base domain',
    [
      ['joint', 'From both meshes'],
      ['qem', 'From the target (QEM)'],
    ] as const,
    (value) => {
      actions.dispatch({ kind: 'options', options: { base: value } });
    },
  );
  const cones = selectOf(
    'Cone angles',
    [
      ['base-domain', 'Of the base domain'],
      ['uniform', 'All equal'],
    ] as const,
    (value) => {
      actions.dispatch({ kind: 'options', options: { cones: value } });
    },
  );
  const mapClass = selectOf(
    'Class',
    [
      ['best', 'The best'],
      ['runner-up', 'The runner-up'],
    ] as const,
    (value) => {
      actions.dispatch({ kind: 'options', options: { class: value } });
    },
  );
  mapClass.select.title = 'Maps of different classes go different ways round a limb';
  const ownCones = selectOf(
    'Own cones',
    [
      ['usual', 'Where they help'],
      ['0', 'None'],
      ['10', 'Up to 10'],
      ['20', 'Up to 20'],
      ['40', 'Up to 40'],
    ] as const,
    (value) => {
      actions.dispatch({ kind: 'options', options: { ownCones: value === 'usual' ? null : Number(value) } });
    },
  );
  ownCones.select.title = 'Points that the program adds as cones of its own where there are at most 16 landmarks';
  root.append(
    make('h2', { class: 'hidden-title' }, 'Map'),
    about,
    make('div', { class: 'row' }, run, finish, cancel),
    bar,
    status,
    residual,
    curve.root,
    make('details', {}, make('summary', {}, 'Advanced'), method.row, base.row, cones.row, mapClass.row, ownCones.row),
  );

  const error = byId('error');
  const errorText = make('p');
  const close = button('×', () => {
    actions.dispatch({ kind: 'error-closed' });
  }, { class: 'icon', 'aria-label': 'Close the message' });
  error.append(errorText, close);
  const hintBox = byId('hint');

  return {
    render(state: State, previous: State | null): void {
      const running = state.job.kind === 'running';
      about.textContent = state.demo === null ? '' : `${state.demo.sentence}.`;
      about.hidden = state.demo === null;
      run.disabled = !canRun(state);
      run.hidden = running;
      const finishable = state.job.kind === 'running' && state.job.finish === 'possible';
      if (!finishable && document.activeElement === finish) {
        // A hidden button would lose the keyboard's place.
        cancel.hidden = !running;
        (running ? cancel : run).focus();
      }
      finish.hidden = !finishable;
      cancel.hidden = !running;
      bar.hidden = !running;
      method.select.value = state.options.method;
      base.select.value = state.options.base;
      cones.select.value = state.options.cones;
      mapClass.select.value = state.options.class;
      ownCones.select.value = state.options.ownCones === null ? 'usual' : String(state.options.ownCones);
      for (const select of [method.select, base.select, cones.select]) {
        select.disabled = running;
      }
      mapClass.select.disabled = running || state.options.method === 'thesis' || state.options.base === 'qem';
      ownCones.select.disabled = running || state.options.method === 'thesis';
      let sentence = idleSentence(state);
      let number = '';
      if (state.job.kind === 'running') {
        const { progress } = state.job;
        sentence = runningSentence(state.job);
        number = progress === null ? '' : progressNumber(progress, state.job.energies.length);
        bar.value = progress === null ? 0 : progress.share;
      } else if (state.job.kind === 'error') {
        sentence = shownResult(state) === null ? 'No map was made.' : 'No new map was made; the last one is shown.';
      }
      if (status.textContent !== sentence) {
        status.textContent = sentence;
      }
      residual.textContent = number;
      residual.hidden = !running;
      curve.show(state.job.kind === 'running' ? state.job.energies : []);
      if (previous !== null && (previous.job.kind === 'running') !== running && document.activeElement === document.body) {
        (running ? cancel : run).focus();
      }
      if (previous?.error !== state.error) {
        error.hidden = state.error === null;
        errorText.textContent = state.error ?? '';
        if (state.error !== null) {
          error.scrollIntoView({ block: 'nearest' });
        }
      }
      const turn = asked(state);
      const next =
        running || !state.ready
          ? ''
          : hint({
              hasSource: state.meshes[0] !== null,
              hasTarget: state.meshes[1] !== null,
              missing: turn === null ? null : { side: turn.side, pair: turn.pair.number },
              pairs: wholePairs(state).length,
              waiting: turn === null ? 0 : waitingCount(state, turn.side) - 1,
            });
      if (hintBox.textContent !== next) {
        hintBox.textContent = next;
      }
      hintBox.hidden = next === '';
    },
  };
}
