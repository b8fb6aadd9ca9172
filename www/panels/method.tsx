/** The fifth step, Method: how a map is made, and which parts of this can be seen on the meshes. */
import type { VNode } from 'preact';
import { integer } from '../numbers.ts';
import type { Report } from '../report.ts';
import type { PartProps } from './actions.ts';
import { BaseView } from './base-view.tsx';
import { CompareView } from './compare-view.tsx';
import { Icon } from './icons.tsx';
import { LineChoice } from './picture-bar.tsx';
import { PlotsButton } from './plots-dialog.tsx';
import { WatchView } from './watch-view.tsx';

interface Stage {
  readonly name: string;
  readonly about: string;
  /** What the last run reports about the stage; `null` where it says nothing. */
  readonly fact: (report: Report) => string | null;
}

const STAGES: readonly Stage[] = [
  {
    name: 'Base domain',
    about: 'A coarse mesh joins the landmarks; it is the same for both meshes.',
    fact: ({ base_domain: base }) => `${integer(base.vertices)} corners, ${integer(base.faces)} triangles`,
  },
  {
    name: 'Layout',
    about: 'Its edges are drawn on both meshes as paths that do not cross.',
    fact: ({ layout }) =>
      layout === null ? null : layout.judged > 1 ? `the best of ${integer(layout.judged)} ways to go round the limbs` : 'one way to go round the limbs',
  },
  {
    name: 'Cones',
    about: 'Each mesh is laid onto the flat surface of the base triangles, which has a cone at every landmark.',
    fact: ({ own_landmarks: own }) => (own === 0 ? null : `${integer(own)} cones of the program’s own`),
  },
  {
    name: 'Relaxation',
    about: 'The map through that surface is smoothed until it distorts both meshes as little as it can.',
    fact: ({ distortion }) => `energy ${distortion.energy.toFixed(3)}; 4 would be no distortion at all`,
  },
  {
    name: 'Certificate',
    about: 'A check that shares nothing with the rest proves that the map is one-to-one.',
    fact: ({ certificate }) => (certificate === null ? 'none for this method' : `${integer(certificate.triangles)} triangles checked`),
  },
];

/** The content of the panel. */
export default function MethodPanel(props: PartProps): VNode {
  const { state, actions, shell } = props;
  const { result } = state;
  return (
    <>
      <CompareView {...props} />
      <BaseView {...props} />
      <WatchView {...props} />
      <section>
        <h3>On the meshes</h3>
        <LineChoice state={state} actions={actions} />
      </section>
      <section>
        <h3>More of it</h3>
        <p class="quiet">The guide explains each stage with its equation, and what the numbers mean.</p>
        <div class="row">
          <button
            type="button"
            id="read-guide"
            onClick={() => {
              shell.set({ dialog: { kind: 'guide', section: 'method' } });
            }}
          >
            <Icon name="guide" />
            Read the guide
          </button>
          {result !== null && <PlotsButton shell={shell} />}
        </div>
      </section>
      <section>
        <h3>From landmarks to a map</h3>
        <ol class="stages">
          {STAGES.map(({ name, about, fact }) => {
            const found = result === null ? null : fact(result.report);
            return (
              <li key={name}>
                <strong>{name}</strong>
                <p class="quiet">{about}</p>
                {found !== null && <p class="small">{found}</p>}
              </li>
            );
          })}
        </ol>
      </section>
    </>
  );
}
