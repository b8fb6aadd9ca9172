/** Saves the landmarks as files. */
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

/** The pairs that have both points, as files of a format: one file, or one for each mesh. Throws `FileRefused`. */
function written(state: State, id: string): readonly NamedBytes[] {
  const landmarks = landmarkFileOf(state);
  const [source, target] = state.meshes;
  const format = formatList().find((candidate) => candidate.id === id);
  if (id === OWN || format === undefined || source === null || target === null) {
    return [{ name: 'landmarks.json', bytes: new TextEncoder().encode(JSON.stringify(landmarks, null, 1)) }];
  }
  return filesOf(format, landmarks, source.mesh, target.mesh);
}

/** Saves the pairs that have both points in a format, which is named by its id in the core. */
export function saveLandmarks(store: Store, format: string = OWN): void {
  try {
    for (const { name, bytes } of written(store.state, format)) {
      // A browser may change the ending of a file whose type it recognises, so only JSON is named.
      download(name, name.endsWith('.json') ? 'application/json' : 'application/octet-stream', bytes.slice());
    }
  } catch (thrown) {
    store.dispatch(errorOf(thrown));
  }
}
