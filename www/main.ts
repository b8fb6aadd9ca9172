/** Wires the store, the views, the panels and the worker together. */
import { openDropped } from './app/dropped.ts';
import { listenForUndo } from './app/keys.ts';
import { mark } from './app/mark.ts';
import { Links } from './app/links.ts';
import { followDemo, freeForgotten, openDemo } from './app/open.ts';
import { saveProject } from './app/projects.ts';
import { repair } from './app/repair.ts';
import { Runner } from './app/run.ts';
import { sharedLink } from './app/sharing.ts';
import { suggest } from './app/suggest.ts';
import { compileCore } from './compute/client.ts';
import { SENTENCES } from './messages.ts';
import { keepOffline } from './offline/register.ts';
import type { Actions } from './panels/actions.ts';
import { mountPage } from './panels/page.tsx';
import type { Demo } from './store/state.ts';
import { Store } from './store/store.ts';
import { Views } from './viewer/viewer.ts';
import init, { demoList } from './wasm/conemap.js';

const store = new Store();
const runner = new Runner(store);
const links = new Links(store);
/** Reloads the page into its newer build, when there is one. */
let reload = (): void => undefined;

const actions: Actions = {
  dispatch: store.dispatch,
  openFiles: (files, side) => {
    void openDropped(store, links, files, side);
  },
  acceptLink: links.accept,
  cancelLink: () => {
    links.cancel();
    // Whoever leaves a link before anything else was there sees what a stranger sees.
    if (store.state.meshes.every((file) => file === null)) {
      void openFirst();
    }
  },
  sharedLink: () => sharedLink(store.state, new URL(document.baseURI)),
  saveProject: () => {
    void saveProject(store);
  },
  reload: () => {
    reload();
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
  fit: () => {
    views.reset();
  },
  lookAtPair: (id) => {
    store.dispatch({ kind: 'pair-selected', id });
  },
  lookAtPlaces: () => {
    views.reset();
  },
};

/** Opens the list, where the selected pair is. */
function showPair(): void {
  store.dispatch({ kind: 'ui', ui: { step: 'landmarks', panel: 'open' } });
}

// The page comes first: the views look for their places in it.
const page = mountPage(store.state, actions);

const views = new Views(store.state, {
  picked: (side, point) => {
    store.dispatch({ kind: 'point-picked', side, point });
  },
  pickDropped: () => {
    store.dispatch({ kind: 'pick-dropped' });
  },
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

/** Opens the demo that a stranger sees first. */
async function openFirst(): Promise<void> {
  const [first] = store.state.demos;
  if (first !== undefined) {
    await openDemo(store, first.id);
  }
}

async function start(): Promise<void> {
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
  if (!(await links.follow())) {
    await openFirst();
  }
  store.dispatch({ kind: 'history-begun' });
  // The core lists its quickest demo last.
  const quickest = demos.at(-1);
  if (quickest !== undefined) {
    runner.warmUp(quickest.id);
  }
  await keepOffline((begin) => {
    reload = begin;
    store.dispatch({ kind: 'outdated' });
  });
}

window.addEventListener('hashchange', () => {
  if (store.state.ready) {
    void links.follow();
  }
});
listenForUndo(store);
window.addEventListener('error', () => {
  fail(SENTENCES.unexpected);
});
window.addEventListener('unhandledrejection', () => {
  fail(SENTENCES.unexpected);
});

void start();
