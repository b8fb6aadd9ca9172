/** The bar at the top: the name of what the page works on, undo and redo, files to save, help and the theme. */
import type { VNode } from 'preact';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';
import { exportsOf } from './exports.ts';
import type { IconName } from './icons.tsx';
import { Icon } from './icons.tsx';
import { documentName } from './names.ts';
import { Popover } from './popover.tsx';
import { Share } from './share.tsx';
import type { Theme } from './shell.ts';

const THEMES: readonly (readonly [Theme, string, IconName])[] = [
  ['system', 'As the system', 'system'],
  ['light', 'Light', 'light'],
  ['dark', 'Dark', 'dark'],
];

function ExportMenu({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const picture = {
    format: 'PNG',
    title: 'Picture of the views',
    about: 'What both views show, twice as large as on the screen',
    save: actions.savePicture,
  };
  const files = state.meshes.every((file) => file === null) ? exportsOf(state, actions) : [...exportsOf(state, actions), picture];
  return (
    <Popover icon="use" label="Export" text="Export" place="down end" disabled={files.length === 0}>
      {(close) =>
        files.map((file) => (
          <button
            key={file.title}
            type="button"
            title={file.about}
            onClick={() => {
              close();
              file.save();
            }}
          >
            {file.title} ({file.format})
          </button>
        ))
      }
    </Popover>
  );
}

function ThemeMenu({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const present = THEMES.find(([theme]) => theme === state.ui.theme);
  return (
    <Popover icon={present?.[2] ?? 'system'} label="Light or dark" place="down end">
      {(close) =>
        THEMES.map(([theme, text, icon]) => (
          <button
            key={theme}
            type="button"
            aria-pressed={theme === state.ui.theme}
            onClick={() => {
              close();
              actions.dispatch({ kind: 'ui', ui: { theme } });
            }}
          >
            <Icon name={icon} />
            {text}
          </button>
        ))
      }
    </Popover>
  );
}

/** The button that goes one step back or forward, with the step's name as its tooltip. */
function Move({ kind, state, actions }: { readonly kind: 'undo' | 'redo' } & Pick<PartProps, 'state' | 'actions'>): VNode {
  const step = (kind === 'undo' ? state.history.past : state.history.future).at(-1);
  const [word, keys] = kind === 'undo' ? ['Undo', 'Ctrl+Z'] : ['Redo', 'Ctrl+Shift+Z'];
  return (
    <IconButton
      icon={kind}
      id={kind}
      label={step === undefined ? `${word} (${keys})` : `${word}: ${step.name} (${keys})`}
      disabled={step === undefined}
      onClick={() => {
        actions.dispatch({ kind });
      }}
    />
  );
}

/** The band. */
export function TopBar({ state, actions, shell }: PartProps): VNode {
  const name = documentName(state);
  return (
    <header id="top">
      <h1>
        <svg viewBox="0 0 24 24" aria-hidden="true">
          <path d="M12 2.500 21 20.500H3zM12 2.500 9 15.500l12 5M9 15.500l-6 5" />
        </svg>
        <span>Conemap</span>
      </h1>
      <p class="title clipped" title={name}>
        <strong class="clipped">{name}</strong>
      </p>
      <Move kind="undo" state={state} actions={actions} />
      <Move kind="redo" state={state} actions={actions} />
      <span class="divide" />
      <Popover icon="share" label="Share" text="Share" place="down end" disabled={!state.ready}>
        {() => <Share state={state} actions={actions} />}
      </Popover>
      <ExportMenu state={state} actions={actions} />
      <span class="divide" />
      <IconButton
        icon="help"
        label="Help: first steps and keys (?)"
        onClick={() => {
          shell.set({ dialog: { kind: 'help' } });
        }}
      />
      <span class="wide-only">
        <IconButton
          icon="guide"
          id="open-guide"
          label="Guide: landmarks, numbers, the method"
          onClick={() => {
            shell.set({ dialog: { kind: 'guide', section: '' } });
          }}
        />
      </span>
      <ThemeMenu state={state} actions={actions} />
    </header>
  );
}
