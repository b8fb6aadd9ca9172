/** Each kind of event: what it changes, and that it changes nothing else. */
import { expect, test } from 'vitest';
import type { Progress } from '../../www/compute/messages.ts';
import type { Side } from '../../www/landmarks.ts';
import type { RunOptions } from '../../www/report.ts';
import { change } from '../../www/store/change.ts';
import type { Event } from '../../www/store/events.ts';
import type { Examined } from '../../www/store/defects.ts';
import type { MeshPlane } from '../../www/store/left-right.ts';
import type { Refused, RefusedMesh } from '../../www/store/refused.ts';
import type { Comparison, Flattening, Offer, Proposal, State, Style, TexturePicture, Ui } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { workOf } from '../../www/store/work.ts';
import { AWAITED, DEMO, DONE, DOUBT, FOUR, MATCH, mesh, OPENED, OUTPUT, pair, PICTURES, READY, REFUSAL, REPORT, RESULT, RUNNING, suggestion, SWAPPED } from './fixtures.ts';
import type { MeshDefects } from '../../www/wasm/page.js';

interface Case<K extends Event['kind']> {
  readonly before: State;
  readonly event: Omit<Extract<Event, { kind: K }>, 'kind'>;
  /** The name of the step; `null` where the event makes none. */
  readonly step: string | null;
  /** The parts of the state that change. Every other part must stay the same object, except the history, which `step` covers. */
  readonly changes: Partial<State>;
}

const TRAP = { code: 'trap', message: 'unreachable' };
const TASK = { sentence: 'Reading the files…' };
const PROGRESS: Progress = { stage: 'relaxation', sentence: 'Relaxing the map', share: 0.5, residual: null, energy: 5 };
const [HORSE, A, B] = [mesh('horse.stl'), suggestion(5, 'A'), suggestion(6, 'B')];
const OPTIONS: RunOptions = { method: 'thesis', base: 'qem', cones: 'uniform', class: 'runner-up', ownCones: 10, borders: 'missing' };
const STYLE: Style = { surface: 'colours', texture: { cells: 12, turn: 30, x: 1, y: -0.5 }, patchLines: false, textureBoundary: true, cones: false, markers: false, morph: 0.25, wipe: 0.75 };
const OFFER: Offer = { session: 'a', names: ['cat.off', 'lion.off'], pairs: 12, saved: 1 };
const [CAT, LION] = READY.meshes;
const PLACES = new Float32Array(9);
const EXAMINED: Examined = { found: {} as unknown as MeshDefects, groups: [], faceCount: 192 };
const ringAt = (side: Side): RefusedMesh => ({
  side,
  file: { name: 'ring.obj', bytes: new Uint8Array(3) },
  allowed: {},
  offer: { kind: 'cut-handles', handles: 1, longest: 0.4 },
  sentence: 'ring.obj: The surface has 1 handle.',
  examined: EXAMINED,
});
const REFUSED: Refused = { meshes: [ringAt(0), ringAt(1)], landmarks: [] };
const PLANE: MeshPlane = { of: LION ?? HORSE, choice: 'x', answer: 'awaited' };
const HALF: State = { ...READY, pairs: [...FOUR, pair(5, 7, null)], nextId: 6 };
/** A state with a map that has proposed a place for the half pair. */
const PROPOSAL: Proposal = { id: 5, of: 7, side: 1, point: 17 };
const PROPOSED: State = { ...HALF, result: DONE.result, job: { kind: 'done' }, proposal: PROPOSAL };
const TWO: State = { ...READY, pairs: FOUR.slice(0, 2) };
const SEARCHING: State = { ...TWO, matching: { kind: 'searching', of: TWO.pairs, share: 0.25, preview: null, ghosts: [] } };
const DOUBTS = [DOUBT];
const DOUBTED: State = { ...READY, found: { doubts: DOUBTS, inputs: workOf(READY) }, findings: DOUBTS };
const during = (job: Partial<typeof RUNNING>): State => ({ ...READY, job: { ...RUNNING, ...job } });
const ui = (state: State, patch: Partial<Ui>): Ui => ({ ...state.ui, ...patch });
const METHOD: State = { ...DONE, ui: ui(DONE, { step: 'method' }) };
const comparedBy = (which: Comparison['which'], progress: Comparison['progress']): Comparison => ({ of: RESULT, which, progress });
const FLATTENING: Flattening = { of: RESULT, progress: { kind: 'computing', share: 0.5 } };
const TEXTURE: TexturePicture = { name: 'tiles.png', width: 1, height: 1, pixels: new Uint8Array(4) };
const toast = (sentence: string): Pick<State, 'toast'> => ({ toast: { sentence, undo: true } });
const gone = (work: State): State['history'] => ({ past: [{ name: 'Place pair 9', work: workOf(work) }], future: [], gesture: 1 });

/** One case for each kind of event; the compiler rejects a missing one. */
const CASES: { readonly [K in Event['kind']]: Case<K> } = {
  ready: {
    before: INITIAL,
    event: { demos: [DEMO] },
    step: null,
    changes: { ready: true, demos: [DEMO] },
  },
  'task-begun': {
    before: DONE,
    event: { task: TASK },
    step: null,
    changes: { job: { kind: 'busy', task: TASK, then: { kind: 'done' } } },
  },
  'task-ended': {
    before: { ...READY, job: { kind: 'busy', task: TASK, then: { kind: 'error' } } },
    event: { task: TASK },
    step: null,
    changes: { job: { kind: 'error' } },
  },
  mesh: {
    before: {
      ...DOUBTED,
      result: DONE.result,
      job: { kind: 'done' },
      demo: DEMO,
      groundTruth: 'truth.txt',
      suggestions: [[A], [B]],
      ui: ui(READY, { selected: 2, hovered: 3, cameras: [[1], [2]] }),
    },
    event: { side: 0, file: HORSE },
    step: 'Open horse.stl',
    changes: {
      meshes: [HORSE, LION],
      up: ['z', 'y'],
      demo: null,
      pairs: [],
      named: [null, null],
      groundTruth: null,
      suggestions: [[], [B]],
      findings: [],
      job: { kind: 'idle' },
      ui: ui(READY, { cameras: [null, [2]] }),
      ...toast('4 landmark pairs removed.'),
    },
  },
  mirrored: {
    before: { ...DOUBTED, demo: DEMO, groundTruth: 'truth.txt', suggestions: [[A], [B]] },
    event: { file: HORSE, points: [20, 21, 22, 23] },
    step: 'Mirror the target',
    changes: {
      meshes: [CAT, HORSE],
      demo: null,
      pairs: [pair(1, 0, 20), pair(2, 1, 21), pair(3, 2, 22), pair(4, 3, 23)],
      named: ['cat.off', 'horse.stl'],
      groundTruth: null,
      suggestions: [[A], []],
      findings: [],
      ui: READY.ui,
      job: { kind: 'idle' },
      ...toast('The target is its mirror image now, with the landmarks on it.'),
    },
  },
  'swap-meshes': {
    before: { ...READY, demo: DEMO, up: ['y', '-z'], pairs: [pair(1, 0, 10), pair(2, null, 11, 'nose')], suggestions: [[A], [B]] },
    event: {},
    step: 'Exchange the meshes',
    changes: {
      meshes: [LION, CAT],
      up: ['-z', 'y'],
      demo: null,
      pairs: [pair(1, 10, 0), pair(2, 11, null, 'nose')],
      named: ['lion.off', 'cat.off'],
      suggestions: [[B], [A]],
      ui: READY.ui,
      job: { kind: 'idle' },
    },
  },
  landmarks: {
    before: { ...DOUBTED, ui: ui(READY, { selected: 2 }) },
    event: {
      file: { source: 'a/horse.off', target: 'b\\camel.off', pairs: [[1, 2]], labels: ['nose'], ground_truth: 'truth.txt' },
    },
    step: 'Load 1 pair',
    changes: {
      pairs: [{ ...pair(5, 1, 2, 'nose'), number: 1 }],
      nextId: 6,
      named: ['horse.off', 'camel.off'],
      groundTruth: 'truth.txt',
      findings: [],
      ui: READY.ui,
      ...toast('4 landmark pairs removed.'),
    },
  },
  'side-marks': {
    before: { ...DOUBTED, error: 'Something failed.' },
    event: { side: 1, points: [{ label: 'nose', point: 20 }], name: 'cat.fcsv' },
    step: 'Load cat.fcsv',
    changes: {
      pairs: [pair(1, 0, null), pair(2, 1, null), pair(3, 2, null), pair(4, 3, null), pair(5, null, 20, 'nose')],
      nextId: 6,
      findings: [],
      error: null,
      ...toast('4 landmark pairs lost a point.'),
    },
  },
  demo: {
    before: { ...READY, error: 'Something failed.' },
    event: { demo: DEMO },
    step: 'Open the demo “Ball”',
    changes: { demo: DEMO, error: null, ...toast('The demo took the place of cat and lion with 4 landmark pairs.') },
  },
  'point-picked': {
    before: { ...HALF, found: DOUBTED.found, findings: [DOUBT], error: 'Something failed.' },
    event: { side: 1, point: 17 },
    step: 'Place pair 5',
    changes: { pairs: [...FOUR, pair(5, 7, 17)], findings: [], error: null, ui: ui(READY, { selected: 5 }) },
  },
  'point-moved': {
    before: { ...DOUBTED, error: 'Something failed.' },
    event: { id: 2, side: 1, point: 17, gesture: 1 },
    step: 'Move pair 2',
    changes: {
      pairs: [pair(1, 0, 10), pair(2, 1, 17), pair(3, 2, 12), pair(4, 3, 13)],
      findings: [],
      error: null,
      ui: ui(READY, { selected: 2 }),
    },
  },
  'pick-dropped': {
    before: { ...HALF, pairs: [...HALF.pairs, pair(6, 8, null)], ui: ui(READY, { selected: 5 }) },
    event: {},
    step: 'Give up pair 5',
    changes: { pairs: [...FOUR, pair(6, 8, null)], ui: ui(READY, { selected: 6 }) },
  },
  'suggestions-taken': {
    before: { ...READY, suggestions: [[A, B], [B]] },
    event: { side: 0 },
    step: 'Take 2 suggestions',
    changes: {
      suggestions: [[], [B]],
      pairs: [...FOUR, pair(5, 5, null), pair(6, 6, null)],
      nextId: 7,
      ui: ui(READY, { selected: 5 }),
    },
  },
  'pair-deleted': {
    before: { ...DOUBTED, ui: ui(READY, { selected: 2, hovered: 2 }) },
    event: { id: 2 },
    step: 'Delete pair 2',
    changes: {
      pairs: [pair(1, 0, 10), pair(3, 2, 12), pair(4, 3, 13)],
      findings: [],
      ui: ui(READY, { selected: 3 }),
      ...toast('Landmark pair 2 deleted.'),
    },
  },
  'pair-labelled': {
    before: DOUBTED,
    event: { id: 3, label: 'tail' },
    step: 'Rename pair 3',
    changes: { pairs: [pair(1, 0, 10), pair(2, 1, 11), pair(3, 2, 12, 'tail'), pair(4, 3, 13)] },
  },
  'pair-locked': {
    before: DOUBTED,
    event: { id: 1, locked: true },
    step: 'Lock pair 1',
    changes: { pairs: [{ ...pair(1, 0, 10), locked: true }, ...FOUR.slice(1)] },
  },
  'pair-softened': {
    before: DOUBTED,
    event: { id: 1, radius: 0.02 },
    step: 'Soften pair 1',
    changes: { pairs: [{ ...pair(1, 0, 10), radius: 0.02 }, ...FOUR.slice(1)] },
  },
  'pair-moved': {
    before: DOUBTED,
    event: { id: 4, to: 1 },
    step: 'Reorder pair 4',
    changes: { pairs: [pair(1, 0, 10), pair(4, 3, 13), pair(2, 1, 11), pair(3, 2, 12)] },
  },
  'pairs-cleared': {
    before: DOUBTED,
    event: {},
    step: 'Delete all pairs',
    changes: { pairs: [], findings: [], ...toast('4 landmark pairs deleted.') },
  },
  'targets-exchanged': {
    before: DOUBTED,
    event: { ids: [1, 4] },
    step: 'Exchange the targets of pair 1 and pair 4',
    changes: { pairs: [pair(1, 0, 13), pair(2, 1, 11), pair(3, 2, 12), pair(4, 3, 10)], findings: [] },
  },
  options: {
    before: { ...READY, options: OPTIONS },
    event: { options: { ownCones: null } },
    step: 'Change the own cones',
    changes: { options: { ...OPTIONS, ownCones: null } },
  },
  restored: {
    before: { ...DOUBTED, nextId: 9, ui: ui(READY, { selected: 2 }), history: gone(READY), error: 'Something failed.' },
    event: {
      work: { ...workOf(READY), meshes: [HORSE, LION], pairs: [pair(1, 5, 6, 'nose'), pair(7, 8, null)], options: OPTIONS },
      history: gone({ ...READY, pairs: [pair(20, 0, 0)] }),
      ui: { theme: 'dark' },
      hadMap: true,
    },
    step: 'Continue with horse and lion',
    changes: {
      meshes: [HORSE, LION],
      mapless: [HORSE, LION],
      pairs: [
        { ...pair(9, 5, 6, 'nose'), number: 1 },
        { ...pair(15, 8, null), number: 7 },
      ],
      nextId: 29,
      options: OPTIONS,
      findings: [],
      error: null,
      suggestions: [[], []],
      ui: ui(READY, { theme: 'dark' }),
      job: { kind: 'idle' },
      ...toast('Continued with horse and lion.'),
    },
  },
  received: {
    before: { ...DOUBTED, nextId: 9, ui: ui(READY, { selected: 2 }), history: gone(READY), error: 'Something failed.' },
    event: { work: { ...workOf(READY), meshes: [HORSE, LION], pairs: [pair(1, 5, 6, 'nose')] }, ui: {} },
    step: 'Open horse and lion',
    changes: {
      meshes: [HORSE, LION],
      pairs: [{ ...pair(9, 5, 6, 'nose'), number: 1 }],
      nextId: 10,
      findings: [],
      error: null,
      suggestions: [[], []],
      ui: ui(READY, {}),
      job: { kind: 'idle' },
      ...toast('Opened horse and lion.'),
    },
  },
  undo: {
    before: {
      ...READY,
      history: gone({ ...READY, pairs: [pair(9, 9, 9)] }),
      ...toast('Something went.'),
      error: 'Something failed.',
    },
    event: {},
    step: null,
    changes: {
      pairs: [pair(9, 9, 9)],
      history: { past: [], future: [{ name: 'Place pair 9', work: workOf(READY) }], gesture: null },
      toast: null,
      error: null,
    },
  },
  redo: {
    before: {
      ...READY,
      history: { past: [], future: [{ name: 'Place pair 9', work: workOf({ ...READY, pairs: [pair(9, 9, 9)] }) }], gesture: null },
    },
    event: {},
    step: null,
    changes: {
      pairs: [pair(9, 9, 9)],
      history: { past: [{ name: 'Place pair 9', work: workOf(READY) }], future: [], gesture: null },
    },
  },
  'history-begun': {
    before: { ...READY, history: gone(READY), ...toast('Something went.') },
    event: {},
    step: null,
    changes: { history: { past: [], future: [], gesture: null }, toast: null },
  },
  'pair-selected': {
    before: READY,
    event: { id: 3 },
    step: null,
    changes: { ui: ui(READY, { selected: 3 }) },
  },
  'pair-hovered': {
    before: READY,
    event: { id: 3 },
    step: null,
    changes: { ui: ui(READY, { hovered: 3 }) },
  },
  ui: {
    before: READY,
    event: { ui: { step: 'map', theme: 'dark', panel: 'folded', link: 'free' } },
    step: null,
    changes: { ui: ui(READY, { step: 'map', theme: 'dark', panel: 'folded', link: 'free' }) },
  },
  style: {
    before: { ...READY, ui: ui(READY, { style: STYLE }) },
    event: { style: { markers: true } },
    step: null,
    changes: { ui: ui(READY, { style: { ...STYLE, markers: true } }) },
  },
  up: {
    before: READY,
    event: { side: 1, axis: '-x' },
    step: null,
    changes: { up: ['y', '-x'] },
  },
  'camera-moved': {
    before: READY,
    event: { side: 1, camera: [1, 2] },
    step: null,
    changes: { ui: ui(READY, { cameras: [null, [1, 2]] }) },
  },
  suggested: {
    before: { ...READY, suggestions: [[A], [B]] },
    event: { side: 1, suggestions: [A, B] },
    step: null,
    changes: { suggestions: [[A], [A, B]] },
  },
  'left-right': {
    before: READY,
    event: { isOn: true },
    step: null,
    changes: { leftRight: { ...READY.leftRight, isOn: true } },
  },
  plane: {
    before: READY,
    event: { side: 1, plane: PLANE },
    step: null,
    changes: { leftRight: { ...READY.leftRight, planes: [null, PLANE] } },
  },
  twins: {
    before: READY,
    event: { twins: [[1, 2]] },
    step: null,
    changes: { leftRight: { ...READY.leftRight, twins: [[1, 2]] } },
  },
  'proposal-accepted': {
    before: PROPOSED,
    event: {},
    step: 'Take the map’s place for pair 5',
    changes: { pairs: [...FOUR, pair(5, 7, 17)], proposal: null, ui: ui(READY, { selected: 5 }) },
  },
  proposed: {
    before: { ...PROPOSED, proposal: null },
    event: { proposal: PROPOSAL },
    step: null,
    changes: { proposal: PROPOSAL },
  },
  'proposal-dropped': {
    before: PROPOSED,
    event: {},
    step: null,
    changes: { proposal: null },
  },
  'search-begun': {
    before: { ...TWO, error: 'Something failed.' },
    event: {},
    step: null,
    changes: { matching: { kind: 'searching', of: TWO.pairs, share: 0, preview: null, ghosts: [] }, error: null },
  },
  'search-progress': {
    before: SEARCHING,
    event: { share: 0.5 },
    step: null,
    changes: { matching: { kind: 'searching', of: TWO.pairs, share: 0.5, preview: null, ghosts: [] } },
  },
  'search-preview': {
    before: SEARCHING,
    event: { places: PLACES, pairs: [[4, 14]] },
    step: null,
    changes: { matching: { kind: 'searching', of: TWO.pairs, share: 0.25, preview: PLACES, ghosts: [[4, 14]] } },
  },
  'search-done': {
    before: SEARCHING,
    event: { report: MATCH, pictures: PICTURES },
    step: 'Find landmarks',
    changes: {
      matching: { kind: 'found', report: MATCH, pictures: PICTURES, isSettled: false },
      pairs: [...TWO.pairs, { ...pair(5, 4, 14, 'end 3'), number: 3 }, { ...pair(6, 5, 15, 'end 4'), number: 4 }],
      nextId: 7,
      ...toast('2 landmark pairs found.'),
    },
  },
  'candidate-taken': {
    before: { ...TWO, matching: { kind: 'found', report: MATCH, pictures: PICTURES, isSettled: false } },
    event: { candidate: 0 },
    step: 'Take answer 1 of the search',
    changes: {
      matching: { kind: 'found', report: MATCH, pictures: PICTURES, isSettled: true },
      pairs: [...TWO.pairs, { ...pair(5, 4, 14, 'end 3'), number: 3 }, { ...pair(6, 5, 15, 'end 4'), number: 4 }],
      nextId: 7,
      ...toast('2 landmark pairs placed as in the chosen answer.'),
    },
  },
  'search-closed': {
    before: SEARCHING,
    event: {},
    step: null,
    changes: { matching: null },
  },
  'comparison-begun': {
    before: METHOD,
    event: { which: 'patchwise' },
    step: null,
    changes: { comparison: comparedBy('patchwise', { kind: 'computing', share: 0 }) },
  },
  comparison: {
    before: { ...METHOD, comparison: comparedBy('start', { kind: 'computing', share: 0.5 }) },
    event: { which: 'start', progress: { kind: 'failed', sentence: 'The flow did not converge.' } },
    step: null,
    changes: { comparison: comparedBy('start', { kind: 'failed', sentence: 'The flow did not converge.' }) },
  },
  'comparison-closed': {
    before: { ...METHOD, comparison: comparedBy('start', { kind: 'computing', share: 0.5 }) },
    event: {},
    step: null,
    changes: { comparison: null },
  },
  flattening: {
    before: METHOD,
    event: { flattening: FLATTENING },
    step: null,
    changes: { flattening: FLATTENING },
  },
  'texture-picture': {
    before: { ...METHOD, error: 'Something failed.' },
    event: { picture: TEXTURE },
    step: null,
    changes: { texturePicture: TEXTURE, error: null, ui: ui(METHOD, { style: { ...METHOD.ui.style, surface: 'picture' } }) },
  },
  'run-started': {
    before: { ...DOUBTED, error: 'Something failed.' },
    event: {},
    step: null,
    changes: { job: RUNNING, found: null, findings: [], error: null },
  },
  'run-progress': {
    before: during({ energies: [[6]] }),
    event: { progress: PROGRESS },
    step: null,
    changes: { job: { ...RUNNING, progress: PROGRESS, energies: [[6, 5]] } },
  },
  'run-relaxes': {
    before: during({ energies: [[6, 5]] }),
    event: {},
    step: null,
    changes: { job: { ...RUNNING, energies: [[6, 5], []] } },
  },
  'run-preview': {
    before: during({}),
    event: { places: PLACES },
    step: null,
    changes: { job: { ...RUNNING, preview: PLACES } },
  },
  'run-finishable': {
    before: during({}),
    event: {},
    step: null,
    changes: { job: { ...RUNNING, finish: 'possible' } },
  },
  'run-finish': {
    before: during({ finish: 'possible' }),
    event: {},
    step: null,
    changes: { job: { ...RUNNING, finish: 'asked' } },
  },
  'run-found': {
    before: during({}),
    event: { findings: [SWAPPED] },
    step: null,
    changes: { found: { doubts: [DOUBT], inputs: RUNNING.inputs }, findings: [DOUBT] },
  },
  'run-done': {
    before: { ...during({}), options: OPTIONS },
    event: { output: OUTPUT, report: REPORT },
    step: null,
    changes: {
      job: { kind: 'done' },
      result: { output: OUTPUT, report: REPORT, inputs: RUNNING.inputs, opened: null },
      ui: ui(READY, { style: { ...READY.ui.style, surface: 'pattern' } }),
    },
  },
  'map-opened': {
    before: { ...READY, awaited: AWAITED, error: 'Something failed.' },
    event: { map: { ...OPENED, report: { ...REPORT, findings: [SWAPPED] } } },
    step: null,
    changes: {
      job: { kind: 'done' },
      result: {
        output: OUTPUT,
        report: { ...REPORT, findings: [SWAPPED] },
        inputs: workOf(READY),
        opened: { name: 'map.conemap', isMirrored: false },
      },
      found: { doubts: [DOUBT], inputs: workOf(READY) },
      findings: [DOUBT],
      ui: ui(READY, { style: { ...READY.ui.style, surface: 'pattern' } }),
      awaited: null,
      error: null,
    },
  },
  'map-awaited': {
    before: READY,
    event: { map: AWAITED },
    step: null,
    changes: { awaited: AWAITED },
  },
  'run-failed': {
    before: during({}),
    event: { sentence: 'No map was found.' },
    step: null,
    changes: { job: { kind: 'error' }, error: 'No map was found.' },
  },
  'proof-begun': {
    before: DONE,
    event: { of: RESULT },
    step: null,
    changes: { proof: { of: RESULT, answer: null } },
  },
  'proof-done': {
    before: { ...DONE, proof: { of: RESULT, answer: null } },
    event: { of: RESULT, answer: REFUSAL },
    step: null,
    changes: { proof: { of: RESULT, answer: REFUSAL } },
  },
  'run-cancelled': {
    before: during({}),
    event: {},
    step: null,
    changes: { job: { kind: 'idle' } },
  },
  toast: {
    before: READY,
    event: { sentence: 'Something went.', undo: true },
    step: null,
    changes: toast('Something went.'),
  },
  'toast-closed': {
    before: { ...READY, ...toast('Something went.') },
    event: {},
    step: null,
    changes: { toast: null },
  },
  offered: {
    before: READY,
    event: { offer: OFFER },
    step: null,
    changes: { offer: OFFER },
  },
  'offer-closed': {
    before: { ...READY, offer: OFFER },
    event: {},
    step: null,
    changes: { offer: null },
  },
  receiving: {
    before: READY,
    event: { receiving: { kind: 'files', missing: [{ side: 0, name: 'cat.off' }] } },
    step: null,
    changes: { receiving: { kind: 'files', missing: [{ side: 0, name: 'cat.off' }] } },
  },
  refused: {
    before: READY,
    event: { refused: REFUSED },
    step: null,
    changes: { refused: REFUSED },
  },
  examined: {
    before: READY,
    event: { side: 1, examined: EXAMINED },
    step: null,
    changes: { examined: [null, EXAMINED] },
  },
  'refused-closed': {
    before: { ...READY, refused: REFUSED },
    event: { side: 1 },
    step: null,
    changes: { refused: { ...REFUSED, meshes: REFUSED.meshes.slice(0, 1) } },
  },
  outdated: {
    before: READY,
    event: {},
    step: null,
    changes: { isOutdated: true },
  },
  undrawn: {
    before: READY,
    event: { sentence: 'There is no WebGL 2.' },
    step: null,
    changes: { undrawn: 'There is no WebGL 2.' },
  },
  error: {
    before: READY,
    event: { sentence: 'Something failed.', failure: TRAP },
    step: null,
    changes: { error: 'Something failed.', breakdown: { sentence: 'Something failed.', failure: TRAP, during: '' } },
  },
  'error-closed': {
    before: { ...READY, error: 'Something failed.' },
    event: {},
    step: null,
    changes: { error: null },
  },
};

test.each(Object.entries(CASES))('%s changes what it should and nothing else', (kind, { before, event, step, changes }) => {
  const state = change(before, [{ kind, ...event } as Event]);
  for (const key of Object.keys(before) as (keyof State)[]) {
    if (key in changes) {
      expect(state[key], key).toEqual(changes[key]);
    } else if (key !== 'history' || step === null) {
      expect(state[key], key).toBe(before[key]);
    }
  }
  if (step !== null) {
    const past = [...before.history.past, { name: step, work: workOf(before) }];
    expect(state.history).toEqual({ past, future: [], gesture: 'gesture' in event ? event.gesture : null });
  }
  // An event without any effect would prove nothing.
  expect(state).not.toEqual(before);
});
