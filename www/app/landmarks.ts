/** Landmarks as files. */
import { download } from '../dom.ts';
import type { NamedBytes } from '../files.ts';
import { filesOf, formatList } from '../landmark-files.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import type { State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { LandmarkFormat } from '../wasm/page.js';
import { errorOf } from './task.ts';

/** The program's own format, which needs no mesh to be written. */
const OWN: LandmarkFormat = 'conemap';

/** The whole pairs as files of a format: one, or one for each mesh. Throws `FileRefused`. */
function written(state: State, id: string): readonly NamedBytes[] {
  const landmarks = landmarkFileOf(state);
  const [source, target] = state.meshes;
  const format = formatList().find((candidate) => candidate.id === id);
  if (id === OWN || format === undefined || source === null || target === null) {
    return [{ name: 'landmarks.json', bytes: new TextEncoder().encode(JSON.stringify(landmarks, null, 1)) }];
  }
  return filesOf(format, landmarks, source.mesh, target.mesh);
}

/** Saves the whole pairs in a format, by the word by which the core knows it. */
export function saveLandmarks(store: Store, format: string = OWN): void {
  try {
    for (const { name, bytes } of written(store.state, format)) {
      // A browser may change the ending of a file whose type it knows better.
      download(name, name.endsWith('.json') ? 'application/json' : 'application/octet-stream', bytes.slice());
    }
  } catch (thrown) {
    store.dispatch(errorOf(thrown));
  }
}
