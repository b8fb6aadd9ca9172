/** Each kind of event: what it changes, and that it changes nothing else. */
import { expect, test } from 'vitest';
import type { RunOptions } from '../../www/report.ts';
import type { Event } from '../../www/store/events.ts';
import { update } from '../../www/store/reducer.ts';
import type { State, Style } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { DEMO, DONE, FOUR, mesh, OUTPUT, pair, READY, REPORT, RUNNING, suggestion, SWAPPED } from './fixtures.ts';

interface Case<K extends Event['kind']> {
  readonly before: State;
  readonly event: Omit<Extract<Event, { kind: K }>, 'kind'>;
  /** Every part of the state that is not named here stays the same object. */
  readonly changes: Partial<State>;
}

const TASK = { sentence: 'Reading the files…' };
const PROGRESS = { stage: 'relaxation', sentence: 'Relaxing the map', share: 0.5, residual: null, energy: 5 };
const [HORSE, A, B] = [mesh('horse.off'), suggestion(5, 'A'), suggestion(6, 'B')];
const PENDING = { side: 0, point: 7 } as const;
const OPTIONS: RunOptions = { method: 'thesis', base: 'qem', cones: 'uniform', class: 'runner-up', ownCones: 10 };
const STYLE: Style = { surface: 'colours', patchLines: false, cones: false, markers: false };
const during = (job: Partial<typeof RUNNING>): State => ({ ...READY, job: { ...RUNNING, ...job } });

/** The compiler asks for a case of each kind. */
const CASES: { readonly [K in Event['kind']]: Case<K> } = {
  ready: {
    before: INITIAL,
    event: { demos: [DEMO] },
    changes: { ready: true, demos: [DEMO] },
  },
  'task-begun': {
    before: DONE,
    event: { task: TASK },
    changes: { job: { kind: 'busy', task: TASK, then: { kind: 'done' } } },
  },
  'task-ended': {
    before: { ...READY, job: { kind: 'busy', task: TASK, then: { kind: 'error' } } },
    event: { task: TASK },
    changes: { job: { kind: 'error' } },
  },
  mesh: {
    before: {
      ...DONE,
      demo: DEMO,
      groundTruth: 'truth.txt',
      pending: PENDING,
      queue: [8],
      suggestions: [[A], [B]],
      history: [[]],
      findings: [SWAPPED],
      style: STYLE,
    },
    event: { side: 0, file: HORSE },
    changes: {
      meshes: [HORSE, DONE.meshes[1]],
      demo: null,
      pairs: [],
      named: [null, null],
      groundTruth: null,
      pending: null,
      queue: [],
      suggestions: [[], [B]],
      history: [],
      result: null,
      findings: [],
      job: { kind: 'idle' },
      style: { ...STYLE, surface: 'shaded' },
    },
  },
  landmarks: {
    before: { ...READY, pending: PENDING, queue: [8], findings: [SWAPPED] },
    event: {
      file: { source: 'a/horse.off', target: 'b\\camel.off', pairs: [[1, 2]], labels: ['nose'], ground_truth: 'truth.txt' },
    },
    changes: {
      pairs: [pair(1, 2, 'nose')],
      named: ['horse.off', 'camel.off'],
      groundTruth: 'truth.txt',
      pending: null,
      queue: [],
      history: [FOUR],
      findings: [],
    },
  },
  demo: {
    before: { ...READY, history: [[]], error: 'Something failed.' },
    event: { demo: DEMO },
    changes: { demo: DEMO, history: [], error: null },
  },
  picked: {
    before: { ...READY, pending: PENDING, findings: [SWAPPED], error: 'Something failed.' },
    event: { side: 1, point: 17 },
    changes: { pairs: [...FOUR, pair(7, 17)], pending: null, queue: [], history: [FOUR], findings: [], error: null },
  },
  'pick-dropped': {
    before: { ...READY, pending: PENDING, queue: [8, 9] },
    event: {},
    changes: { pending: { side: 0, point: 8 }, queue: [9] },
  },
  suggested: {
    before: { ...READY, suggestions: [[A], [B]] },
    event: { side: 1, suggestions: [A, B] },
    changes: { suggestions: [[A], [A, B]] },
  },
  'suggestions-taken': {
    before: { ...READY, suggestions: [[A, B], [B]] },
    event: { side: 0 },
    changes: { suggestions: [[], [B]], pending: { side: 0, point: 5 }, queue: [6] },
  },
  'pair-deleted': {
    before: { ...READY, findings: [SWAPPED] },
    event: { index: 1 },
    changes: { pairs: [pair(0, 10), pair(2, 12), pair(3, 13)], history: [FOUR], findings: [] },
  },
  'pair-labelled': {
    before: READY,
    event: { index: 2, label: 'tail' },
    changes: { pairs: [pair(0, 10), pair(1, 11), pair(2, 12, 'tail'), pair(3, 13)] },
  },
  'pairs-cleared': {
    before: { ...READY, pending: PENDING, queue: [8], findings: [SWAPPED] },
    event: {},
    changes: { pairs: [], pending: null, queue: [], history: [FOUR], findings: [] },
  },
  'targets-exchanged': {
    before: { ...READY, findings: [SWAPPED] },
    event: { indices: [0, 3] },
    changes: { pairs: [pair(0, 13), pair(1, 11), pair(2, 12), pair(3, 10)], history: [FOUR], findings: [] },
  },
  undo: {
    before: { ...READY, history: [[pair(8, 8)], [pair(9, 9)]], findings: [SWAPPED] },
    event: {},
    changes: { pairs: [pair(9, 9)], history: [[pair(8, 8)]], findings: [] },
  },
  options: {
    before: { ...READY, options: OPTIONS },
    event: { options: { ownCones: null } },
    changes: { options: { ...OPTIONS, ownCones: null } },
  },
  style: {
    before: { ...READY, style: STYLE },
    event: { style: { markers: true } },
    changes: { style: { ...STYLE, markers: true } },
  },
  'run-started': {
    before: { ...DONE, pending: PENDING, queue: [8], findings: [SWAPPED], error: 'Something failed.' },
    event: {},
    changes: { job: RUNNING, pending: null, queue: [], findings: [], error: null },
  },
  'run-progress': {
    before: during({ energies: [[6]] }),
    event: { progress: PROGRESS },
    changes: { job: { ...RUNNING, progress: PROGRESS, energies: [[6, 5]] } },
  },
  'run-relaxes': {
    before: during({ energies: [[6, 5]] }),
    event: {},
    changes: { job: { ...RUNNING, energies: [[6, 5], []] } },
  },
  'run-finishable': {
    before: during({}),
    event: {},
    changes: { job: { ...RUNNING, finish: 'possible' } },
  },
  'run-finish': {
    before: during({ finish: 'possible' }),
    event: {},
    changes: { job: { ...RUNNING, finish: 'asked' } },
  },
  'run-found': {
    before: during({}),
    event: { findings: [SWAPPED] },
    changes: { findings: [SWAPPED] },
  },
  'run-done': {
    before: { ...during({}), options: OPTIONS },
    event: { output: OUTPUT, report: REPORT },
    changes: {
      job: { kind: 'done' },
      result: { output: OUTPUT, report: REPORT, pairs: FOUR, options: OPTIONS },
      style: { ...READY.style, surface: 'checkerboard' },
    },
  },
  'run-failed': {
    before: during({}),
    event: { sentence: 'No map was found.' },
    changes: { job: { kind: 'error' }, error: 'No map was found.' },
  },
  'run-cancelled': {
    before: during({}),
    event: {},
    changes: { job: { kind: 'idle' } },
  },
  error: {
    before: READY,
    event: { sentence: 'Something failed.' },
    changes: { error: 'Something failed.' },
  },
  'error-closed': {
    before: { ...READY, error: 'Something failed.' },
    event: {},
    changes: { error: null },
  },
};

test.each(Object.entries(CASES))('%s changes what it should and nothing else', (kind, { before, event, changes }) => {
  const state = update(before, { kind, ...event } as Event);
  for (const key of Object.keys(before) as (keyof State)[]) {
    if (key in changes) {
      expect(state[key], key).toEqual(changes[key]);
    } else {
      expect(state[key], key).toBe(before[key]);
    }
  }
  // An event that could be left out would prove nothing.
  expect(state).not.toEqual(before);
});
