/** Begins a search for landmarks unasked where the user's two meshes came without any; the first click on a mesh ends the search. */
import { canSearch } from '../store/search.ts';
import type { State } from '../store/state.ts';
import type { Store } from '../store/store.ts';

/** The most faces of a mesh for which the search begins unasked: it takes a second for every few thousand faces. */
const MOST_FACES = 100_000;

/** Calls `start` once for every two meshes that come without landmarks, when the page is at rest again. */
export function findUnasked(store: Store, start: () => void): void {
  // Sessions that earlier versions kept name the demo, but not its meshes.
  const isBare = ({ meshes, pairs, awaited, demo }: State): boolean =>
    pairs.length === 0 &&
    awaited === null &&
    demo === null &&
    meshes.every((file) => file !== null && file.faceCount <= MOST_FACES && file.ofDemo === undefined);
  const seen = new WeakSet<State['meshes']>();
  let waiting: State['meshes'] | null = null;
  store.subscribe((state, previous) => {
    if (state.meshes !== previous.meshes) {
      // Meshes that come back by undo and redo were looked at before.
      waiting = seen.has(state.meshes) ? null : state.meshes;
      seen.add(state.meshes);
    }
    if (waiting === null || state.receiving.kind !== 'nothing' || !canSearch(state)) {
      return;
    }
    waiting = null;
    if (isBare(state)) {
      // The search starts only after the store has told all listeners of the present change.
      queueMicrotask(start);
    }
  });
}
