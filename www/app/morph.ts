/**
 * The way of the source to the target's shape. It is computed when it is first shown; until it has come, and where it fails, each point
 * moves on a straight line.
 */
import type { Core } from '../compute/core.ts';
import type { Way } from '../compute/saved-messages.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { askMap } from './made-files.ts';

/**
 * Has the way of each map computed once, when it is first shown, and gives it to `take`. The returned function asks for the way of the
 * shown map.
 */
export function bendMorphs(store: Store, coreOf: () => Core | null, take: (output: Result['output'], way: Way) => void): () => void {
  const asked = new WeakSet<Result['output']>();
  const ask = async (core: Core, result: Result): Promise<void> => {
    const { output } = result;
    const [source, target] = output.sides;
    const points = { source: source.positions, target: target.positions, triangles: output.triangles, faces: output.faces[0] };
    try {
      const way = await askMap(core, result, (saved) => saved.way(points));
      if (shownResult(store.state)?.output === output) {
        take(output, way);
      } else {
        // The way is asked for again when that map comes back.
        asked.delete(output);
      }
    } catch (thrown) {
      console.warn(thrown);
    }
  };
  const want = (): void => {
    const result = shownResult(store.state);
    const core = coreOf();
    // Only a map with a map file can be asked for its way.
    const isThere = (result?.output.map ?? null) !== null;
    if (isThere && result !== null && core !== null && !asked.has(result.output)) {
      asked.add(result.output);
      void ask(core, result);
    }
  };
  store.subscribe((state) => {
    if (state.ui.style.morph > 0) {
      want();
    }
  });
  return want;
}
