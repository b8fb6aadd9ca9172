/** Wires the state, the views, the panels and the worker together. */
import { compileCore, startRun, warmUp } from './compute/client.ts';
import type { Run } from './compute/client.ts';
import { failureOf } from './compute/messages.ts';
import type { NamedBytes } from './files.ts';
import { eventsOf, FileRefused, landmarkFile, meshFile, mirroredTarget } from './files.ts';
import { failureSentence, SENTENCES } from './messages.ts';
import { displayPanel } from './panels/display.ts';
import { filesPanel } from './panels/files.ts';
import { findingsPanel } from './panels/findings.ts';
import { landmarksPanel, lookAtPair } from './panels/landmarks.ts';
import type { Actions, Panel } from './panels/panel.ts';
import { resultPanel } from './panels/result.ts';
import { runPanel } from './panels/run.ts';
import type { Finding, Report } from './report.ts';
import type { Demo, Event, Side, State, Suggestion } from './state.ts';
import { canRun, INITIAL, landmarkFileOf, pointsOf, SIDES, update } from './state.ts';
import { Views } from './viewer/viewer.ts';
import init, { buildDemo, demoList, suggestLandmarks } from './wasm/conemap.js';

let state: State = INITIAL;
let core: WebAssembly.Module | null = null;
let run: Run | null = null;
let endWarmUp = (): void => undefined;
/** Counts loads, so that a slow one does not overwrite a later one. */
let loads = 0;

function dispatch(...events: readonly Event[]): void {
  const previous = state;
  state = events.reduce(update, state);
  if (state === previous) {
    return;
  }
  views.sync(state, previous);
  for (const panel of panels) {
    panel.render(state, previous);
  }
  for (const side of SIDES) {
    const old = previous.meshes[side];
    if (old !== null && old !== state.meshes[side]) {
      old.mesh.free();
    }
  }
  mark();
  if (previous.demo !== null && state.demo === null) {
    history.replaceState(null, '', location.pathname + location.search);
  }
}

/** Says on the body where the page is. */
function mark(): void {
  const { dataset } = document.body;
  dataset['ready'] = String(state.ready);
  dataset['state'] = state.job.kind;
  dataset['demo'] = state.demo?.id ?? '';
}

function fail(sentence: string): void {
  dispatch({ kind: 'error', sentence });
}

/** Lets the browser draw what was said before the page is busy. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, 200);
    requestAnimationFrame(() => {
      clearTimeout(timer);
      setTimeout(resolve, 0);
    });
  });
}

const LARGEST_FILE = 2 ** 30;

async function bytesOf(file: File): Promise<NamedBytes> {
  if (file.size > LARGEST_FILE) {
    throw new FileRefused(`${file.name} ${SENTENCES.tooLarge}`);
  }
  if (file.size === 0) {
    throw new FileRefused(`${file.name} ${SENTENCES.empty}`);
  }
  try {
    return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  } catch {
    throw new FileRefused(`${file.name}: ${SENTENCES.unreadable}`);
  }
}

async function openFiles(files: readonly File[], side: Side | null): Promise<void> {
  if (!state.ready) {
    return;
  }
  const load = ++loads;
  dispatch({ kind: 'error-closed' }, { kind: 'busy', sentence: 'Reading the files…' });
  try {
    const named = await Promise.all(files.map(bytesOf));
    await painted();
    if (load === loads) {
      if (state.job.kind === 'running') {
        throw new FileRefused(SENTENCES.whileRunning);
      }
      dispatch(...eventsOf(named, side, state));
    }
  } catch (thrown) {
    fail(thrown instanceof FileRefused ? thrown.message : failureSentence(failureOf(thrown)));
  } finally {
    if (load === loads) {
      dispatch({ kind: 'busy', sentence: null });
    }
  }
}

function demoEvents(demo: Demo): Event[] {
  const built = buildDemo(demo.id);
  if (built === undefined) {
    throw new FileRefused(SENTENCES.noDemo);
  }
  const source = meshFile({ name: `${demo.id}-source.obj`, bytes: built.source() });
  const target = meshFile({ name: `${demo.id}-target.obj`, bytes: built.target() });
  const landmarks = landmarkFile({ name: `${demo.id}.json`, bytes: built.landmarks() });
  built.free();
  return [
    { kind: 'mesh', side: 0, file: source },
    { kind: 'mesh', side: 1, file: target },
    { kind: 'landmarks', file: landmarks },
    { kind: 'demo', demo },
  ];
}

async function openDemo(id: string): Promise<void> {
  const demo = state.demos.find((candidate) => candidate.id === id);
  if (demo === undefined) {
    fail(SENTENCES.noDemo);
    return;
  }
  if (state.job.kind === 'running') {
    fail(SENTENCES.whileRunning);
    return;
  }
  const load = ++loads;
  dispatch({ kind: 'busy', sentence: `Building the demo “${demo.title}”…` });
  await painted();
  if (load !== loads) {
    return;
  }
  try {
    dispatch(...demoEvents(demo));
    history.replaceState(null, '', `#demo=${encodeURIComponent(id)}`);
  } catch (thrown) {
    fail(thrown instanceof FileRefused ? thrown.message : failureSentence(failureOf(thrown)));
  } finally {
    dispatch({ kind: 'busy', sentence: null });
  }
}

function linkedDemo(): string | null {
  return new URLSearchParams(location.hash.slice(1)).get('demo');
}

function compute(): void {
  const [source, target] = state.meshes;
  if (core === null || source === null || target === null || !canRun(state)) {
    return;
  }
  endWarmUp();
  dispatch({ kind: 'run-started' });
  run = startRun(
    {
      module: core,
      source: source.bytes,
      target: target.bytes,
      landmarks: JSON.stringify(landmarkFileOf(state)),
      options: state.options,
    },
    {
      progress: (progress) => {
        dispatch({ kind: 'run-progress', progress });
      },
      relaxes: () => {
        dispatch({ kind: 'run-relaxes' });
      },
      finishable: () => {
        dispatch({ kind: 'run-finishable' });
      },
      found: (findings) => {
        dispatch({ kind: 'run-found', findings });
      },
      done: (output) => {
        run = null;
        dispatch({ kind: 'run-done', output, report: JSON.parse(output.report) as Report });
      },
      failed: (failure) => {
        run = null;
        console.error(failure);
        dispatch({ kind: 'run-failed', sentence: failureSentence(failure) });
      },
    },
  );
}

function cancel(): void {
  run?.cancel();
  run = null;
  if (state.job.kind === 'running') {
    dispatch({ kind: 'run-cancelled' });
  }
}

function finish(): void {
  run?.finish();
  dispatch({ kind: 'run-finish' });
}

/** Suggestions with letters for names, in their order. */
function lettered(found: readonly { point: number; reason: Suggestion['reason']; partner: number | null }[]): Suggestion[] {
  const letter = (index: number): string => String.fromCharCode(65 + (index % 26));
  return found.map(({ point, reason, partner }, index) => ({
    point,
    reason,
    letter: letter(index),
    partner: partner === null ? null : letter(partner),
  }));
}

const SUGGESTIONS = 12;

/** Marks places of one mesh that are worth a landmark. */
async function suggest(side: Side): Promise<void> {
  const file = state.meshes[side];
  if (file === null || state.job.kind === 'running') {
    return;
  }
  dispatch({ kind: 'error-closed' }, { kind: 'busy', sentence: 'Looking for places that are worth a landmark…' });
  await painted();
  try {
    if (file === state.meshes[side]) {
      const marked = pointsOf(state, side).concat(state.pending?.side === side ? state.queue : []);
      const json = suggestLandmarks(file.mesh, JSON.stringify(marked.filter((point) => point !== null)), SUGGESTIONS);
      const suggestions = lettered(JSON.parse(json) as Parameters<typeof lettered>[0]);
      dispatch({ kind: 'suggested', side, suggestions });
      if (suggestions.length === 0) {
        fail(SENTENCES.nothingToSuggest);
      }
    }
  } catch (thrown) {
    fail(failureSentence(failureOf(thrown)));
  } finally {
    dispatch({ kind: 'busy', sentence: null });
  }
}

/** Does what a finding asks for; a run with the old pairs ends. */
function repair(finding: Finding): void {
  try {
    switch (finding.repair) {
      case 'swap':
        cancel();
        dispatch({ kind: 'targets-exchanged', indices: finding.pairs });
        break;
      case 'mirror_target': {
        const target = state.meshes[1];
        if (target !== null) {
          const events = mirroredTarget(target, landmarkFileOf(state));
          cancel();
          dispatch(...events);
        }
        break;
      }
      case 'mark':
        if (finding.side !== null) {
          const ends = finding.vertices.map((point) => ({ point, reason: 'tip' as const, partner: null }));
          dispatch({ kind: 'suggested', side: finding.side, suggestions: lettered(ends) });
        }
        break;
      case 'check':
        lookAtPair(finding.pairs[0] ?? 0);
        break;
    }
  } catch (thrown) {
    fail(thrown instanceof FileRefused ? thrown.message : failureSentence(failureOf(thrown)));
  }
}

const actions: Actions = {
  dispatch,
  openFiles: (files, side) => {
    void openFiles(files, side);
  },
  openDemo: (id) => {
    void openDemo(id);
  },
  suggest: (side) => {
    void suggest(side);
  },
  run: compute,
  finish,
  cancel,
  repair,
};

const views = new Views(state, {
  picked: (side, point) => {
    dispatch({ kind: 'picked', side, point });
  },
  pickDropped: () => {
    dispatch({ kind: 'pick-dropped' });
  },
  failed: (sentence) => {
    // After the change that is being shown.
    queueMicrotask(() => {
      dispatch(sentence === '' ? { kind: 'error-closed' } : { kind: 'error', sentence });
    });
  },
});
const panels: readonly Panel[] = [
  filesPanel(actions),
  runPanel(actions),
  findingsPanel(actions),
  resultPanel(),
  displayPanel(actions, () => {
    views.reset();
  }),
  landmarksPanel(actions),
];

async function start(): Promise<void> {
  for (const panel of panels) {
    panel.render(state, null);
  }
  try {
    core = await compileCore();
    await init({ module_or_path: core });
  } catch (thrown) {
    console.error(thrown);
    fail(SENTENCES.noCore);
    return;
  }
  await views.start();
  const demos = JSON.parse(demoList()) as Demo[];
  dispatch({ kind: 'ready', demos });
  const linked = linkedDemo();
  const first = demos[0];
  if (linked !== null) {
    await openDemo(linked);
  } else if (first !== undefined) {
    await openDemo(first.id);
  }
  if (run === null) {
    endWarmUp = warmUp(core);
  }
}

window.addEventListener('hashchange', () => {
  const linked = linkedDemo();
  if (linked !== null && linked !== state.demo?.id) {
    void openDemo(linked);
  }
});
window.addEventListener('keydown', (event) => {
  const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
  if ((event.ctrlKey || event.metaKey) && !event.shiftKey && event.key.toLowerCase() === 'z' && !typing && state.job.kind !== 'running') {
    event.preventDefault();
    dispatch({ kind: 'undo' });
  }
});
window.addEventListener('error', () => {
  fail(SENTENCES.unexpected);
});
window.addEventListener('unhandledrejection', () => {
  fail(SENTENCES.unexpected);
});

void start();
