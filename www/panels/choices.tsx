/** How the map is made: choices that most people leave as they are. */
import type { VNode } from 'preact';
import type { RunOptions } from '../report.ts';
import type { PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { Select } from './controls.tsx';

const METHODS: readonly Choice<RunOptions['method']>[] = [
  { value: 'relaxed', text: 'Relaxed, certified' },
  { value: 'thesis', text: 'Patch by patch' },
  { value: 'tutte', text: 'Patchwise Tutte' },
];
const BASES: readonly Choice<RunOptions['base']>[] = [
  { value: 'joint', text: 'From both meshes' },
  { value: 'qem', text: 'From the target (QEM)' },
];
const CONES: readonly Choice<RunOptions['cones']>[] = [
  { value: 'base-domain', text: 'Of the base domain' },
  { value: 'uniform', text: 'All equal' },
];
const CLASSES: readonly Choice<RunOptions['class']>[] = [
  { value: 'best', text: 'The best' },
  { value: 'runner-up', text: 'The runner-up' },
];
const OWN_CONES: readonly Choice<string>[] = [
  { value: 'usual', text: 'Where they help' },
  { value: '0', text: 'None' },
  { value: '10', text: 'Up to 10' },
  { value: '20', text: 'Up to 20' },
  { value: '40', text: 'Up to 40' },
];

const BORDERS: readonly Choice<RunOptions['borders']>[] = [
  { value: 'guess', text: 'As the landmarks tell' },
  { value: 'corresponding', text: 'Ends of both bodies' },
  { value: 'missing', text: 'Missing data' },
];

/** The choices. */
export function Choices({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const { options } = state;
  const running = state.job.kind === 'running';
  const unrelaxed = options.method !== 'relaxed';
  const set = (change: Partial<RunOptions>): void => {
    actions.dispatch({ kind: 'options', options: change });
  };
  return (
    <div class="choices">
      <Select label="Method" value={options.method} choices={METHODS} disabled={running} onChoice={(method) => { set({ method }); }} />
      <Select label="Base domain" value={options.base} choices={BASES} disabled={running} onChoice={(base) => { set({ base }); }} />
      <Select label="Cone angles" value={options.cones} choices={CONES} disabled={running} onChoice={(cones) => { set({ cones }); }} />
      <Select
        label="Class"
        title="Maps of different classes go different ways round a limb"
        value={options.class}
        choices={CLASSES}
        disabled={running || unrelaxed || options.base === 'qem'}
        onChoice={(chosen) => {
          set({ class: chosen });
        }}
      />
      <Select
        label="Own cones"
        title="Points that the program adds as cones of its own where there are at most 16 landmarks"
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
        choices={BORDERS}
        disabled={running || unrelaxed}
        onChoice={(borders) => {
          set({ borders });
        }}
      />
    </div>
  );
}
