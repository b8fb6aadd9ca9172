/** Wires the store, the views, the panels and the worker together. */
import { BROWSER, Keeper } from './app/keep.ts';
import { listenForUndo } from './app/keys.ts';
import { mark } from './app/mark.ts';
import { followDemo, freeForgotten, linkedDemo, openDemo, openFiles } from './app/open.ts';
import { repair } from './app/repair.ts';
import { Runner } from './app/run.ts';
import { suggest } from './app/suggest.ts';
import { compileCore } from './compute/client.ts';
import { SENTENCES } from './messages.ts';
import type { Side } from './landmarks.ts';
import type { Actions, CameraCommand } from './panels/actions.ts';
import { mountPage } from './panels/page.tsx';
import type { Demo } from './store/state.ts';
import { Store } from './store/store.ts';
import { Views } from './viewer/viewer.ts';
import init, { demoList } from './wasm/conemap.js';

const store = new Store();
const runner = new Runner(store);
const keeper = new Keeper(store, BROWSER);

const actions: Actions = {
  dispatch: store.dispatch,
  openFiles: (files, side) => {
    void openFiles(store, files, side);
  },
  openDemo: (id) => {
    void openDemo(store, id);
  },
  suggest: (side) => {
    void suggest(store, side);
  },
  run: () => {
    runner.start();
  },
  finish: () => {
    runner.finish();
  },
  cancel: () => {
    runner.cancel();
  },
  repair: (finding) => {
    repair(store, runner, showPair, finding);
  },
  camera: (side, command) => {
    turn(side, command);
  },
  proposedUp: (side) => views.proposedUp(side),
  lookAtPair: (id) => {
    views.lookAtPair(id);
  },
  lookAtPlaces: ([source, target]) => {
    views.lookAt(0, source);
    views.lookAt(1, target);
    views.ask(0, source);
  },
  continueWork: () => {
    void keeper.accept();
  },
  startAnew: () => {
    void keeper.decline();
  },
};

/** Opens the list, where the selected pair is, and turns both views to it. */
function showPair(id: number): void {
  store.dispatch({ kind: 'ui', ui: { step: 'landmarks', panel: 'open' } });
  views.lookAtPair(id);
}

function turn(side: Side, command: CameraCommand): void {
  switch (command.kind) {
    case 'fit':
      views.fit(side);
      break;
    case 'reset':
      views.reset(side);
      break;
    case 'look':
      views.lookFrom(side, command.from);
      break;
    case 'roll':
      views.roll(side, command.degrees);
      break;
  }
}

// The page comes first: the views look for their places in it.
const page = mountPage(store.state, actions);

const views = new Views(store.state, {
  dispatch: store.dispatch,
  // The views may say this while they show a change; it is the next change then, not one within.
  failed: (sentence) => {
    queueMicrotask(() => {
      fail(sentence);
    });
  },
  recovered: () => {
    queueMicrotask(() => {
      store.dispatch({ kind: 'error-closed' });
    });
  },
  probed: page.probed,
});

store.subscribe((state, previous) => {
  page.sync(state, previous);
  views.sync(state, previous);
});
store.subscribe(freeForgotten);
store.subscribe(mark);
store.subscribe(followDemo);

function fail(sentence: string): void {
  store.dispatch({ kind: 'error', sentence });
}

/** Shows the first demo, or the one that the address names, where nobody has put anything else there. */
async function showFirst(demos: readonly Demo[]): Promise<void> {
  const first = linkedDemo() ?? demos[0]?.id;
  if (first !== undefined && store.state.job.kind === 'idle' && store.state.history.past.length === 0) {
    if (await openDemo(store, first)) {
      store.dispatch({ kind: 'history-begun' });
    }
  }
}

async function start(): Promise<void> {
  const finding = keeper.find(linkedDemo());
  try {
    const core = await compileCore();
    await init({ module_or_path: core });
    runner.use(core);
  } catch (thrown) {
    console.error(thrown);
    fail(SENTENCES.noCore);
    return;
  }
  await views.start();
  const demos = JSON.parse(demoList()) as Demo[];
  store.dispatch({ kind: 'ready', demos });
  if (!(await keeper.resume(await finding))) {
    await showFirst(demos);
  }
  // The core lists its quickest demo last.
  const quickest = demos.at(-1);
  if (quickest !== undefined) {
    runner.warmUp(quickest.id);
  }
}

window.addEventListener('hashchange', () => {
  const linked = linkedDemo();
  if (linked !== null && linked !== store.state.demo?.id) {
    void openDemo(store, linked);
  }
});
listenForUndo(store);
// The last sign of life that a browser promises.
document.addEventListener('visibilitychange', () => {
  if (document.visibilityState === 'hidden') {
    void keeper.flush();
  }
});
window.addEventListener('pagehide', () => {
  void keeper.flush();
});
window.addEventListener('error', () => {
  fail(SENTENCES.unexpected);
});
window.addEventListener('unhandledrejection', () => {
  fail(SENTENCES.unexpected);
});

void start();
