/** Makes files, a wrapped base or a proof of the map when the user asks for them, from its map file in a worker of their own. */
import type { SavedMapHandle } from '../compute/saved-client.ts';
import type { Core } from '../compute/core.ts';
import { openSavedMap, SavedMapError } from '../compute/saved-client.ts';
import { download } from '../dom.ts';
import { FileRefused } from '../files.ts';
import { failureSentence } from '../messages.ts';
import type { Result } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { errorOf, performBeside } from './task.ts';

/** Opens a map in a worker of its own, and returns what `use` asks of it. Throws `FileRefused`. */
export async function askMap<T>(core: Core, { output, inputs }: Result, use: (saved: SavedMapHandle) => Promise<T>): Promise<T> {
  const [source, target] = inputs.meshes;
  if (output.map === null || source === null || target === null) {
    throw new FileRefused('This map has no map file, from which more could be made: the relaxed method gives one.');
  }
  let saved: SavedMapHandle | null = null;
  try {
    saved = openSavedMap(core, { map: output.map, source: source.bytes, target: target.bytes, pictures: [source.picture, target.picture] }, 'files');
    await saved.opened;
    return await use(saved);
  } catch (thrown) {
    throw thrown instanceof SavedMapError ? new FileRefused(failureSentence(thrown.failure), { failure: thrown.failure }) : thrown;
  } finally {
    saved?.close();
  }
}

/** A file of a map: the core's name for it, the name under which it is saved, and its type. */
interface MadeFile {
  readonly made: string;
  readonly name: string;
  readonly type: string;
}

/** Saves a file of the map on the page. */
export async function saveMadeFile(store: Store, core: Core, { made, name, type }: MadeFile): Promise<void> {
  const { result } = store.state;
  if (result !== null) {
    await performBeside(store, `Making ${name}…`, () => askMap(core, result, (saved) => saved.file(made)), (bytes) => {
      download(name, type, bytes);
    });
  }
}

/** Saves the source's own file with its vertices laid onto the target, and shows a sentence about the result. */
export async function saveWrapped(store: Store, core: Core): Promise<void> {
  const { result } = store.state;
  const source = result?.inputs.meshes[0] ?? null;
  if (result === null || source === null) {
    return;
  }
  await performBeside(store, `Laying ${source.name} onto the target…`, () => askMap(core, result, (saved) => saved.wrapped()), ({ bytes, sentence }) => {
    download(`wrapped-${source.name}`, 'application/octet-stream', bytes);
    store.dispatch({ kind: 'toast', sentence, undo: false });
  });
}

/** Has the map on the page proved by the second program, which is independent of the one that made the map. */
export async function proveMap(store: Store, core: Core): Promise<void> {
  const { result } = store.state;
  if (result === null) {
    return;
  }
  store.dispatch({ kind: 'proof-begun', of: result });
  try {
    const answer = await askMap(core, result, (saved) => saved.proof());
    store.dispatch({ kind: 'proof-done', of: result, answer });
  } catch (thrown) {
    store.dispatch({ kind: 'proof-done', of: result, answer: null }, errorOf(thrown));
  }
}
