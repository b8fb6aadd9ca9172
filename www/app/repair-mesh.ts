/** Repairs a refused mesh as the page has offered, and shows where a mesh was repaired. */
import { repairedEvents } from '../opening.ts';
import { examinedOf } from '../files.ts';
import type { Side } from '../landmarks.ts';
import type { FileReader } from '../reading/reader.ts';
import { readMesh } from '../reading/reader.ts';
import type { Examined } from '../store/defects.ts';
import type { RefusedMesh } from '../store/refused.ts';
import { allowedBy } from '../store/refused.ts';
import type { State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { perform } from './task.ts';

/** Repairs a refused mesh and opens the result in its place. */
export async function repairMesh(store: Store, reader: FileReader, mesh: RefusedMesh): Promise<void> {
  const { kind } = store.state.job;
  if (kind === 'running' || kind === 'busy') {
    return;
  }
  store.dispatch({ kind: 'error-closed' });
  await perform(
    store,
    `Repairing ${mesh.file.name}…`,
    (signal) => readMesh(reader, mesh.file, allowedBy(mesh), signal),
    (reading) => {
      if (store.state.refused?.meshes.includes(mesh) === true) {
        store.dispatch(...repairedEvents(mesh, reading, store.state));
      }
    },
  );
}

/** Shows or hides what was wrong with the mesh of a side before it was repaired. */
export async function showRepairs(store: Store, reader: FileReader, side: Side, shown: 'shown' | 'hidden'): Promise<void> {
  const file = store.state.meshes[side];
  if (shown === 'hidden' || file === null) {
    store.dispatch({ kind: 'examined', side, examined: null });
    return;
  }
  await perform(
    store,
    `Looking at ${file.name}…`,
    (signal) => reader.ask({ kind: 'repairs', bytes: file.bytes, mesh: file.mesh.packed() }, signal),
    (found) => {
      if (store.state.meshes[side] === file) {
        store.dispatch({ kind: 'examined', side, examined: examinedOf(found) });
      }
    },
  );
}

/** The examinations of defects that the page shows. */
function held({ refused, examined }: State): Set<Examined> {
  return new Set([...examined, ...(refused?.meshes ?? []).map((mesh) => mesh.examined)].filter((one) => one !== null));
}

/** Frees the core's memory of defects that the page no longer shows. */
export function freeExamined(state: State, previous: State): void {
  if (state.refused === previous.refused && state.examined === previous.examined) {
    return;
  }
  const present = held(state);
  for (const examined of held(previous)) {
    if (!present.has(examined)) {
      examined.found.free();
    }
  }
}
