/** The options of how the map is made, which most users leave as they are. */
import type { VNode } from 'preact';
import {
  BASES,
  BORDERS,
  CLASSES,
  CONES,
  METHODS,
  MOST_LANDMARKS_WITH_OWN_CONES,
  MOST_POSE_LANDMARKS_WITH_OWN_CONES,
} from '../options.ts';
import type { RunOptions } from '../report.ts';
import type { PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { choicesOf, Select } from './controls.tsx';

const OWN_CONES: readonly Choice<string>[] = [
  { value: 'usual', text: 'Where they help' },
  { value: '0', text: 'None' },
  { value: '10', text: 'Up to 10' },
  { value: '20', text: 'Up to 20' },
  { value: '40', text: 'Up to 40' },
];

/** The options. */
export function Choices({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const { options } = state;
  const running = state.job.kind === 'running';
  const unrelaxed = options.method !== 'relaxed';
  const set = (change: Partial<RunOptions>): void => {
    actions.dispatch({ kind: 'options', options: change });
  };
  return (
    <div class="choices">
      <Select label="Method" value={options.method} choices={choicesOf(METHODS)} disabled={running} onChoice={(method) => { set({ method }); }} />
      <Select label="Base domain" value={options.base} choices={choicesOf(BASES)} disabled={running} onChoice={(base) => { set({ base }); }} />
      <Select label="Cone angles" value={options.cones} choices={choicesOf(CONES)} disabled={running} onChoice={(cones) => { set({ cones }); }} />
      <Select
        label="Class"
        title="Maps of different classes go different ways round a limb"
        value={options.class}
        choices={choicesOf(CLASSES)}
        disabled={running || unrelaxed || options.base === 'qem'}
        onChoice={(chosen) => {
          set({ class: chosen });
        }}
      />
      <Select
        label="Own cones"
        title={`Points that the program adds as cones of its own where there are at most ${MOST_LANDMARKS_WITH_OWN_CONES} landmarks, or ${MOST_POSE_LANDMARKS_WITH_OWN_CONES} between two poses of one body; with 0 also none at ends of limbs without a landmark`}
        value={options.ownCones === null ? 'usual' : String(options.ownCones)}
        choices={OWN_CONES}
        disabled={running || unrelaxed}
        onChoice={(value) => {
          set({ ownCones: value === 'usual' ? null : Number(value) });
        }}
      />
      <Select
        label="Rims of holes"
        title="Whether large holes of both meshes are where both bodies end, so that rim goes to rim, or places that a scan has missed"
        value={options.borders}
        choices={choicesOf(BORDERS)}
        disabled={running || unrelaxed}
        onChoice={(borders) => {
          set({ borders });
        }}
      />
    </div>
  );
}
