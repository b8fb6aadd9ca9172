/** The rail of the steps at the left edge, which shows the open step and the progress of each. */
import type { VNode } from 'preact';
import type { State } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import type { IconName } from './icons.tsx';
import { Icon } from './icons.tsx';
import type { Mark, Step } from './steps.ts';
import { markOf, STEPS } from './steps.ts';

export const STEP_NAMES: Readonly<Record<Step, string>> = {
  meshes: 'Meshes',
  landmarks: 'Landmarks',
  map: 'Map',
  use: 'Use',
  method: 'Method',
};

const MARK_WORDS: Readonly<Record<Mark, string>> = {
  empty: 'nothing yet',
  ready: 'ready',
  running: 'at work',
  done: 'done',
  outdated: 'look again',
};

const MARK_ICONS: Readonly<Partial<Record<Mark, IconName>>> = { done: 'check', outdated: 'again' };

/** Opens a step; for the step that is open already, folds the panel away. */
export function openStep(state: State, actions: Actions, step: Step): void {
  const folds = step === state.ui.step && state.ui.panel === 'open';
  actions.dispatch({ kind: 'ui', ui: { step, panel: folds ? 'folded' : 'open' } });
}

function StepButton({ step, index, state, actions }: { readonly step: Step; readonly index: number } & PartProps): VNode {
  const mark = markOf(state, step);
  const icon = MARK_ICONS[mark];
  const name = STEP_NAMES[step];
  return (
    <button
      type="button"
      id={`step-${step}`}
      title={`${name}: ${MARK_WORDS[mark]} (${index + 1})`}
      aria-label={`${name}, ${MARK_WORDS[mark]}`}
      aria-current={state.ui.step === step ? 'step' : undefined}
      aria-controls="panel"
      onClick={() => {
        openStep(state, actions, step);
      }}
    >
      <Icon name={step} />
      <span>{name}</span>
      <span class={`step-mark ${mark}`}>{icon !== undefined && <Icon name={icon} />}</span>
    </button>
  );
}

/** The rail. */
export function Rail(props: PartProps): VNode {
  const folded = props.state.ui.panel === 'folded';
  return (
    <nav id="rail" aria-label="Steps">
      <div class="steps">
        {STEPS.map((step, index) => (
          <StepButton key={step} step={step} index={index} {...props} />
        ))}
      </div>
      <button
        type="button"
        class="fold"
        title={folded ? 'Show the panel' : 'Fold the panel away'}
        aria-label={folded ? 'Show the panel' : 'Fold the panel away'}
        aria-expanded={!folded}
        aria-controls="panel"
        onClick={() => {
          props.actions.dispatch({ kind: 'ui', ui: { panel: folded ? 'open' : 'folded' } });
        }}
      >
        <Icon name={folded ? 'unfold' : 'fold'} />
      </button>
    </nav>
  );
}
