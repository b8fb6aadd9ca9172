/** The dialog that explains the first steps and the keys. */
import type { VNode } from 'preact';
import { Fragment } from 'preact';
import { Dialog } from './dialog.tsx';
import type { Shell } from './shell.ts';

const FIRST_STEPS = [
  'Drop two closed meshes on the page, or look at a demo.',
  'Click a place on one mesh, then the same place on the other: four pairs at least, ten are good.',
  'Press “Map … onto …”: the map is made here in your browser, nothing is sent anywhere.',
  'Look at the pattern and the worst places; add a pair where the map goes astray, and make it again.',
];

interface Keys {
  readonly title: string;
  readonly keys: readonly (readonly [readonly string[], string])[];
}

const KEYS: readonly Keys[] = [
  {
    title: 'Everywhere',
    keys: [
      [['1', '–', '5'], 'open a step'],
      [['Ctrl', 'Z'], 'undo'],
      [['Ctrl', 'Shift', 'Z'], 'redo'],
      [['Esc'], 'leave what the page is busy with, or a comparison'],
      [['?'], 'this help'],
    ],
  },
  {
    title: 'In a view',
    keys: [
      [['drag'], 'turn; with Shift or the right button move'],
      [['wheel'], 'nearer and farther'],
      [['double-click'], 'look there and turn about it'],
      [['←', '↑', '→', '↓'], 'turn; with Shift move; a selected landmark is nudged'],
      [['+', '−'], 'nearer and farther, also Page Up and Page Down'],
      [['Q', 'E'], 'turn the picture'],
      [['F'], 'the whole mesh; 0 the first look'],
      [['Shift', 'F B L R T U'], 'from the front, back, left, right, top, under'],
      [['Space'], 'place a landmark in the middle, also Enter'],
      [['Enter'], 'with a map: take the place that it proposes'],
      [['Del'], 'delete the selected pair'],
      [['Esc'], 'drop a proposal, give up a half pair, or the selection'],
    ],
  },
  {
    title: 'In the list of landmarks',
    keys: [
      [['↑', '↓'], 'select; with Alt reorder'],
      [['Enter'], 'turn both views to the pair'],
      [['F2'], 'rename'],
      [['L'], 'lock'],
      [['Del'], 'delete'],
    ],
  },
  {
    title: 'On the line between the views',
    keys: [
      [['←', '→'], 'share the width'],
      [['Enter'], 'one view alone, or both'],
    ],
  },
];

function KeyList({ title, keys }: Keys): VNode {
  return (
    <section>
      <h3>{title}</h3>
      <dl>
        {keys.map(([combination, meaning]) => (
          <Fragment key={meaning}>
            <dt>
              {combination.map((key) => (
                <kbd key={key}>{key}</kbd>
              ))}
            </dt>
            <dd class="quiet">{meaning}</dd>
          </Fragment>
        ))}
      </dl>
    </section>
  );
}

/** The dialog; it covers the page while it is open. */
export function Help({ shell }: { readonly shell: Shell }): VNode {
  const isOpen = shell.state.dialog?.kind === 'help';
  const close = (): void => {
    if (shell.state.dialog?.kind === 'help') {
      shell.set({ dialog: null });
    }
  };
  return (
    <Dialog id="help" kind="help" title="First steps and keys" closing="Close the help" isOpen={isOpen} onClose={close}>
      <div class="columns">
        <section>
          <h3>First steps</h3>
          <ol>
            {FIRST_STEPS.map((step) => (
              <li key={step}>{step}</li>
            ))}
          </ol>
          <button
            type="button"
            onClick={() => {
              shell.set({ dialog: { kind: 'guide', section: '' } });
            }}
          >
            Read the guide
          </button>
        </section>
        {KEYS.map((keys) => (
          <KeyList key={keys.title} {...keys} />
        ))}
      </div>
    </Dialog>
  );
}
