/** The whole page. It is rendered anew after every change, and only what differs is changed in the document. */
import type { VNode } from 'preact';
import { render } from 'preact';
import { byId, isTyped } from '../dom.ts';
import type { State } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import { GuideDialog } from './guide-dialog.tsx';
import { Help } from './help.tsx';
import { FileInputs } from './inputs.tsx';
import { documentName } from './names.ts';
import { Panel } from './panel.tsx';
import { PlotsDialog } from './plots-dialog.tsx';
import { openStep, Rail } from './rail.tsx';
import type { Probe, Theme } from './shell.ts';
import { Shell } from './shell.ts';
import { Stage } from './stage.tsx';
import { StatusLine } from './status.tsx';
import { stepAfter, STEPS } from './steps.ts';
import { TopBar } from './top-bar.tsx';

function Page(props: PartProps): VNode {
  const { state, actions, shell } = props;
  return (
    <>
      <TopBar {...props} />
      <Rail {...props} />
      <Stage {...props} />
      <Panel {...props} />
      <StatusLine {...props} />
      <Help shell={shell} />
      <GuideDialog {...props} />
      <PlotsDialog {...props} />
      <FileInputs state={state} actions={actions} />
    </>
  );
}

/** Handles the keys that open steps and the help; keys that are typed into a field belong to the field. */
function listenForKeys(state: () => State, actions: Actions, shell: Shell): void {
  window.addEventListener('keydown', (event) => {
    if (isTyped(event.target) || event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey || event.altKey) {
      return;
    }
    const step = STEPS[Number(event.key) - 1];
    if (event.key === '?') {
      shell.set({ dialog: shell.state.dialog?.kind === 'help' ? null : { kind: 'help' } });
    } else if (step !== undefined && shell.state.dialog === null) {
      openStep(state(), actions, step);
    }
  });
}

/** The screens on which the panel is a sheet over the views; the same query as in www/styles/phone.css. */
const PHONE = '(max-width: 600px), (max-width: 860px) and (orientation: portrait)';

/** Sets the theme on the root element, where the style sheets read it. */
function applyTheme(theme: Theme): void {
  document.documentElement.dataset['theme'] = theme;
}

/** Draws the page; the keyboard goes to the head of the panel where a drawing removes the control of it, or the card of a demo, that had it. */
function keepingFocus(draw: () => void): void {
  const active = document.activeElement;
  const hadKeyboard = active?.matches(':focus-visible') === true && active.closest('#panel, .demo-card') !== null;
  draw();
  if (!hadKeyboard) {
    return;
  }
  // Whoever made the change may give the focus elsewhere.
  queueMicrotask(() => {
    if (!active.isConnected && document.activeElement === document.body) {
      byId('panel-title').focus();
    }
  });
}

/** The functions by which the page hears of changes. */
export interface Mounted {
  /** Called when the state has changed. */
  readonly sync: (state: State, previous: State) => void;
  /** Called with the map at the place under the mouse; `null` when the mouse has left. */
  readonly probed: (probe: Probe | null) => void;
  /** Opens the guide at a section; empty for its beginning. */
  readonly openGuide: (section: string) => void;
}

/** Shows the page for the first time; afterwards `sync` keeps it up to date. */
export function mountPage(initial: State, actions: Actions): Mounted {
  const root = byId('app');
  const shell = new Shell();
  let state = initial;
  const draw = (): void => {
    root.classList.toggle('folded', state.ui.panel === 'folded');
    keepingFocus(() => {
      render(<Page state={state} actions={actions} shell={shell} />, root);
    });
  };
  shell.subscribe(draw);
  listenForKeys(() => state, actions, shell);
  applyTheme(shell.theme);
  draw();
  if (window.matchMedia(PHONE).matches) {
    // A small screen shows the views first; the main action is visible even so.
    queueMicrotask(() => {
      actions.dispatch({ kind: 'ui', ui: { panel: 'folded' } });
    });
  }
  if (shell.theme !== initial.ui.theme) {
    queueMicrotask(() => {
      actions.dispatch({ kind: 'ui', ui: { theme: shell.theme } });
    });
  }
  return {
    probed: (probe) => {
      shell.set({ probe });
    },
    openGuide: (section) => {
      shell.set({ dialog: { kind: 'guide', section } });
    },
    sync: (next, previous) => {
      state = next;
      if (next.ui.theme !== previous.ui.theme) {
        applyTheme(next.ui.theme);
        shell.rememberTheme(next.ui.theme);
      }
      draw();
      document.title = next.meshes.every((file) => file === null) ? 'Conemap' : `${documentName(next)} – Conemap`;
      const step = stepAfter(next, previous);
      if (step !== null && step !== next.ui.step) {
        // The step is changed by an event of its own, after the present one.
        queueMicrotask(() => {
          actions.dispatch({ kind: 'ui', ui: { step } });
        });
      }
    },
  };
}
