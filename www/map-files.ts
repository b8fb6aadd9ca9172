/** Map files before they are opened: which they are, whose they are, and whether the meshes on the page are theirs. */
import { failureOf } from './compute/messages.ts';
import type { Side } from './landmarks.ts';
import { SIDES } from './landmarks.ts';
import { fileSentence, otherMesh, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import { shownName } from './send/address.ts';
import type { AwaitedMap, WantedMesh } from './store/awaited.ts';
import type { MeshFile, State } from './store/state.ts';
import { isMapFile as isMap, wantedMeshes } from './wasm/page.js';

/** The ending of map files, as a chooser is told. */
export const MAP_ENDING = '.conemap';

/** Whether a file says of itself that it is a map file. */
export function isMapFile({ bytes }: Pick<NamedBytes, 'bytes'>): boolean {
  // Only its beginning is handed to the core.
  return isMap(bytes.subarray(0, 8));
}

const hashes = new WeakMap<MeshFile, string>();

/** What tells a mesh from others; a mesh never changes. */
function hashOf(file: MeshFile): string {
  const hash = hashes.get(file) ?? file.mesh.checkedHash();
  hashes.set(file, hash);
  return hash;
}

function isIt(wanted: WantedMesh, file: MeshFile | null): boolean {
  return file !== null && hashOf(file) === wanted.checked;
}

/** A map file with the meshes that it wants, by its header. Throws {@link FileRefused}. */
export function headOf({ name, bytes }: NamedBytes): AwaitedMap {
  try {
    const [source, target] = JSON.parse(wantedMeshes(bytes)) as [WantedMesh, WantedMesh];
    const shown = (mesh: WantedMesh): WantedMesh => ({ ...mesh, name: shownName(mesh.name ?? '') || null });
    return { name, bytes, meshes: [shown(source), shown(target)] };
  } catch (thrown) {
    throw new FileRefused(fileSentence(name, failureOf(thrown)));
  }
}

/** The sides on which a map's meshes are not. */
export function missingOf(map: AwaitedMap, meshes: State['meshes']): readonly Side[] {
  return SIDES.filter((side) => !isIt(map.meshes[side], meshes[side]));
}

/** The side of a map that a mesh is the only right one for; `null` where it is none or both. */
export function sideIn(map: AwaitedMap, file: MeshFile): Side | null {
  const [isSource, isTarget] = map.meshes.map((wanted) => isIt(wanted, file));
  return isSource === isTarget ? null : isSource === true ? 0 : 1;
}

/**
 * Whether a map can be opened now, or waits for meshes: a side that is empty, or a demo's, takes what comes. `before` is the page
 * without the meshes that come with the map. Throws {@link FileRefused} where a mesh is another one.
 */
export function checkMeshes(map: AwaitedMap, meshes: State['meshes'], before: Pick<State, 'meshes' | 'demo'>): 'fits' | 'waits' {
  const missing = missingOf(map, meshes);
  if (missing.length > 0 && isIt(map.meshes[0], meshes[1]) && isIt(map.meshes[1], meshes[0])) {
    throw new FileRefused(`${map.name}: ${SENTENCES.exchangedMeshes}`);
  }
  for (const side of missing) {
    const file = meshes[side];
    const makesRoom = file === null || (before.demo !== null && file === before.meshes[side]);
    if (!makesRoom) {
      throw new FileRefused(`${map.name}: ${otherMesh(side, file.name, map.meshes[side].name)}`);
    }
  }
  return missing.length === 0 ? 'fits' : 'waits';
}
