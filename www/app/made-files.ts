/** Files of the map that are made when somebody asks for them: from its map file, in a worker of their own. */
import type { SavedMapHandle } from '../compute/saved-client.ts';
import { openSavedMap, SavedMapError } from '../compute/saved-client.ts';
import { download } from '../dom.ts';
import { FileRefused } from '../files.ts';
import { failureSentence } from '../messages.ts';
import type { Result } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { perform, sentenceOf } from './task.ts';

/** The file of a map by its name, as the core lists them. Throws `FileRefused`. */
async function fileOf(core: WebAssembly.Module, { output, inputs }: Result, name: string): Promise<Uint8Array<ArrayBuffer>> {
  const [source, target] = inputs.meshes;
  if (output.map === null || source === null || target === null) {
    throw new FileRefused(`This map gives no file ${name}.`);
  }
  let saved: SavedMapHandle | null = null;
  try {
    saved = openSavedMap(core, { map: output.map, source: source.bytes, target: target.bytes }, 'files');
    await saved.opened;
    return await saved.file(name);
  } catch (thrown) {
    throw thrown instanceof SavedMapError ? new FileRefused(failureSentence(thrown.failure)) : thrown;
  } finally {
    saved?.close();
  }
}

/** A file of a map: the core's name for it, that under which it is saved, and its type. */
interface MadeFile {
  readonly made: string;
  readonly name: string;
  readonly type: string;
}

/** Saves a file of the map on the page. */
export async function saveMadeFile(store: Store, core: WebAssembly.Module, { made, name, type }: MadeFile): Promise<void> {
  const { job, result } = store.state;
  if (result === null) {
    return;
  }
  const save = (bytes: Uint8Array<ArrayBuffer>): void => {
    download(name, type, bytes);
  };
  if (job.kind === 'running' || job.kind === 'busy') {
    // Neither a run nor other work is given up for a file, which is made beside it.
    await fileOf(core, result, made).then(save, (thrown: unknown) => {
      store.dispatch({ kind: 'error', sentence: sentenceOf(thrown) });
    });
    return;
  }
  await perform(store, `Making ${name}…`, () => fileOf(core, result, made), save);
}
