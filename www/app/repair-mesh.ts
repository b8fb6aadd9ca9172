/** Repairs a mesh that was refused, as it was offered. */
import { repairedEvents } from '../opening.ts';
import type { RefusedMesh } from '../store/refused.ts';
import type { Store } from '../store/store.ts';
import { perform } from './task.ts';

/** Repairs a mesh and puts it in its place. */
export async function repairMesh(store: Store, mesh: RefusedMesh): Promise<void> {
  const { kind } = store.state.job;
  if (kind === 'running' || kind === 'busy') {
    return;
  }
  store.dispatch({ kind: 'error-closed' });
  await perform(
    store,
    `Repairing ${mesh.file.name}…`,
    () => mesh,
    () => {
      if (store.state.refused?.meshes.includes(mesh) === true) {
        store.dispatch(...repairedEvents(mesh, store.state));
      }
    },
  );
}
