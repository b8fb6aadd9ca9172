/** Begins to look for landmarks by itself where the user's two meshes came without any; the first click on a mesh ends that. */
import { canSearch } from '../store/search.ts';
import type { MeshFile, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';

/** Meshes of more faces are asked for by a click: the search takes a second for every few thousand. */
const MOST_FACES = 100_000;

/** Starts a search for every two meshes that come without landmarks, when the page is at rest again. */
export function findUnasked(store: Store, start: () => void): void {
  const ofDemos = new WeakSet<MeshFile>();
  const isBare = ({ meshes, pairs, awaited }: State): boolean =>
    pairs.length === 0 &&
    awaited === null &&
    meshes.every((file) => file !== null && file.faceCount <= MOST_FACES && !ofDemos.has(file));
  const seen = new WeakSet<State['meshes']>();
  let waiting: State['meshes'] | null = null;
  store.subscribe((state, previous) => {
    if (state.demo !== null) {
      state.meshes.filter((file) => file !== null).forEach((file) => ofDemos.add(file));
    }
    if (state.meshes !== previous.meshes) {
      // Those that come back by undo and redo were looked at before.
      waiting = seen.has(state.meshes) ? null : state.meshes;
      seen.add(state.meshes);
    }
    if (waiting === null || state.receiving.kind !== 'nothing' || !canSearch(state)) {
      return;
    }
    waiting = null;
    if (isBare(state)) {
      // The change that is being told comes first.
      queueMicrotask(start);
    }
  });
}
