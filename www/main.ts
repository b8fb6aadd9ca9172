/** Wires the store, the views, the panels and the worker together. */
import { Dropped } from './app/dropped.ts';
import { Finder } from './app/find.ts';
import { findUnasked } from './app/find-unasked.ts';
import { First } from './app/first.ts';
import { browserWith, Keeper } from './app/keep.ts';
import { listenForLeaving, listenForProposal, listenForUndo } from './app/keys.ts';
import { saveLandmarks } from './app/landmarks.ts';
import { mark } from './app/mark.ts';
import { completed, Planes } from './app/left-right.ts';
import type { Mirror } from './app/left-right.ts';
import { bendMorphs } from './app/morph.ts';
import { Links } from './app/links.ts';
import { Maps } from './app/maps.ts';
import { followDemo, freeForgotten, openDemo, showOwnLink } from './app/open.ts';
import { proveMap, saveMadeFile, saveWrapped } from './app/made-files.ts';
import { saveProject } from './app/projects.ts';
import { listenForHalves } from './app/propose.ts';
import { mirror, repair } from './app/repair.ts';
import { freeExamined, repairMesh, showRepairs } from './app/repair-mesh.ts';
import { Runner } from './app/run.ts';
import { leaveTask } from './app/task.ts';
import { seeFoundAlike, showOwnShape, showPair, turn } from './app/turn.ts';
import { sharedLink } from './app/sharing.ts';
import { suggest } from './app/suggest.ts';
import { Comparer } from './app/compare.ts';
import { Flattener } from './app/flatten.ts';
import { openTexturePicture } from './app/texture-picture.ts';
import { startFlowing, startLayingOut, startSimplifying } from './app/watch.ts';
import { compilePage, coreSource } from './compute/core.ts';
import { failureOf } from './compute/messages.ts';
import { SENTENCES } from './messages.ts';
import { download } from './dom.ts';
import { keepOffline } from './offline/register.ts';
import type { TurnedViews } from './method/hands.ts';
import type { Actions } from './panels/actions.ts';
import { mountPage } from './panels/page.tsx';
import { Reader } from './reading/reader.ts';
import { guideSection } from './send/guide-link.ts';
import type { Demo } from './store/state.ts';
import { shownResult } from './store/staleness.ts';
import { Store } from './store/store.ts';
import { Views } from './viewer/viewer.ts';
import init, { demoList } from './wasm/page.js';

/** How many times larger the picture file of the views is than the views on the screen. */
const PICTURE_SCALE = 2;

const store = new Store();
// The reader's worker is fetched and started while the page's module is.
const reader = new Reader();
const runner = new Runner(store);
const links = new Links(store, reader);
const maps = new Maps(store, () => runner.core);
const finder = new Finder(store, () => runner.core);
const comparer = new Comparer(store, () => runner.core);
new Flattener(store, () => runner.core);
const wantWay = bendMorphs(
  store,
  () => runner.core,
  (output, way) => {
    views.takeWay(output, way);
  },
);
const across: Mirror = (side, point) => views.across(side, point);
/** Reloads the page into its newer build, where there is one. */
let reload = (): void => undefined;
const keeper = new Keeper(store, browserWith(reader));
const dropped = new Dropped(store, { links, reader, maps });
const first = new First(store, links, reader, dropped);

const turnedViews: TurnedViews = {
  whenTurned: (heard) => views.whenTurned(heard),
  axes: (side) => views.axes(side),
};

const actions: Actions = {
  dispatch: store.dispatch,
  openFiles: (files, side) => {
    void dropped.open(files, side);
  },
  acceptLink: links.accept,
  cancelLink: () => {
    links.cancel();
    // A visitor who gives up a link before anything else was on the page sees the first demo.
    if (first.isMissing()) {
      void first.open(store.state.demos);
    }
  },
  sharedLink: () => sharedLink(store.state, new URL(document.baseURI)),
  openTexturePicture: (file) => {
    void openTexturePicture(store, file);
  },
  saveProject: () => {
    void saveProject(store);
  },
  saveLandmarks: (format) => {
    saveLandmarks(store, format);
  },
  saveMadeFile: (file) => {
    if (runner.core !== null) {
      void saveMadeFile(store, runner.core, file);
    }
  },
  saveWrapped: () => {
    if (runner.core !== null) {
      void saveWrapped(store, runner.core);
    }
  },
  bring: {
    core: () => runner.core,
    shown: () => shownResult(store.state),
  },
  proveMap: () => {
    if (runner.core !== null) {
      void proveMap(store, runner.core);
    }
  },
  savePicture: () => {
    void views.picture(PICTURE_SCALE).then((picture) => {
      if (picture !== null) {
        download('conemap.png', 'image/png', picture);
      }
    });
  },
  reload: () => {
    reload();
  },
  openDemo: (id) => {
    void openDemo(store, reader, id);
  },
  findLandmarks: () => {
    finder.start();
  },
  choosePlane: (side, choice) => {
    planes.choose(side, choice);
  },
  suggest: (side) => {
    void suggest(store, reader, side);
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
  leaveTask: () => {
    leaveTask(store);
  },
  repair: (finding) => {
    const lookAtPair = (id: number): void => {
      showPair(store, views, id);
    };
    repair(store, { runner, reader, lookAtPair }, finding);
  },
  mirrorTarget: () => {
    void mirror(store, { runner, reader });
  },
  repairMesh: (mesh) => {
    void repairMesh(store, reader, mesh);
  },
  showRepairs: (side, shown) => {
    void showRepairs(store, reader, side, shown);
  },
  lookAtDefect: (side, examined, group, index) => {
    showOwnShape(store);
    views.lookAtDefect(side, examined.found, group, index);
  },
  camera: (side, command) => {
    turn(views, side, command);
  },
  morph: (share) => {
    wantWay();
    views.morph(share);
  },
  turnedViews,
  baseView: {
    ...turnedViews,
    open: () => views.openBase(),
    orbit: (side, dx, dy, way) => {
      views.orbit(side, dx, dy, way);
    },
    light: (part) => {
      views.light(part);
    },
  },
  flow: {
    start: (listener, scheme) => startFlowing(store, runner.core, listener, scheme),
    show: (frame) => {
      views.showFlow(frame);
    },
    mark: (stops) => {
      views.markStops(stops);
    },
    lookAtStop: (side, found, index) => {
      showOwnShape(store);
      views.lookAtDefect(side, found, 0, index);
    },
  },
  simplification: {
    start: (listener, from) => startSimplifying(store, runner.core, listener, from),
    show: (frame) => {
      views.showStage(frame);
    },
  },
  plane: {
    start: (listener) => startLayingOut(store, runner.core, listener),
  },
  compare: (other) => {
    comparer.choose(other);
  },
  proposedUp: (side) => views.proposedUp(side),
  lookAtPair: (id) => {
    showOwnShape(store);
    views.lookAtPair(id);
  },
  lookAtPlaces: ([source, target]) => {
    showOwnShape(store);
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

// The page is mounted first, because the views look for their elements in it.
const page = mountPage(store.state, actions);

const views = new Views(store.state, {
  dispatch: store.dispatch,
  // The views may report this while they show a change, so it is dispatched as a change of its own.
  failed: (sentence) => {
    queueMicrotask(() => {
      fail(sentence);
    });
  },
  undrawn: (sentence) => {
    queueMicrotask(() => {
      store.dispatch({ kind: 'undrawn', sentence });
    });
  },
  probed: page.probed,
});

store.subscribe((state, previous) => {
  page.sync(state, previous);
  views.sync(state, previous);
});
store.completeBy((state, event) => completed(state, event, across));
listenForHalves(store, views);
findUnasked(store, () => {
  finder.start();
});
seeFoundAlike(store, views);
// The views must hear of a plane before anybody asks them for the point across it.
const planes = new Planes(store, reader, across);
store.subscribe(freeForgotten);
store.subscribe(freeExamined);
store.subscribe(mark);
store.subscribe(followDemo);

function fail(sentence: string): void {
  store.dispatch({ kind: 'error', sentence });
}

/** Opens the guide where the address asks for it, and removes that from the address again; returns whether it did. */
function followGuide(): boolean {
  const section = guideSection(location.hash);
  if (section === null) {
    return false;
  }
  showOwnLink(store.state);
  page.openGuide(section);
  return true;
}

async function start(): Promise<void> {
  followGuide();
  const finding = keeper.find(links.named);
  const core = coreSource();
  try {
    const module = await compilePage();
    reader.use(module, core);
    await init({ module_or_path: module });
  } catch (thrown) {
    console.error(thrown);
    fail(SENTENCES.noCore);
    return;
  }
  runner.use(core);
  const demos = JSON.parse(demoList()) as Demo[];
  const found = await finding;
  // The demo is built while the views start.
  const expected = found.own === null ? first.expected(demos) : null;
  if (expected !== null) {
    reader.foresee(expected.id);
  }
  await views.start();
  store.dispatch({ kind: 'ready', demos });
  if (!(await keeper.resume(found))) {
    await first.show(demos);
  }
  dropped.begin();
  // Once the page can be used it fetches the core. The core lists its quickest demo last.
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
  if (!followGuide() && store.state.ready) {
    void links.follow();
  }
});
listenForUndo(store);
listenForProposal(store);
listenForLeaving(store);
// The last event that a browser promises before it closes a page.
document.addEventListener('visibilitychange', () => {
  if (document.visibilityState === 'hidden') {
    void keeper.flush();
  }
});
window.addEventListener('pagehide', () => {
  void keeper.flush();
});
window.addEventListener('error', ({ error, message }) => {
  store.dispatch({ kind: 'error', sentence: SENTENCES.unexpected, failure: failureOf(error ?? message) });
});
window.addEventListener('unhandledrejection', ({ reason }) => {
  store.dispatch({ kind: 'error', sentence: SENTENCES.unexpected, failure: failureOf(reason) });
});

void start();
