/** Map files before they are opened: whether a file is one, which meshes it wants, and whether these are on the page. */
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

/** The ending of map files, for a file chooser. */
export const MAP_ENDING = '.conemap';

/** Whether a file begins like a map file. */
export function isMapFile({ bytes }: Pick<NamedBytes, 'bytes'>): boolean {
  // The core is given only the file's beginning.
  return isMap(bytes.subarray(0, 8));
}

const hashes = new WeakMap<MeshFile, string>();

/** The hash that identifies a mesh; a mesh never changes. */
function hashOf(file: MeshFile): string {
  const hash = hashes.get(file) ?? file.mesh.checkedHash();
  hashes.set(file, hash);
  return hash;
}

function isIt(wanted: WantedMesh, file: MeshFile | null): boolean {
  return file !== null && hashOf(file) === wanted.checked;
}

/** A map file with the meshes that its header names. Throws {@link FileRefused}. */
export function headOf({ name, bytes }: NamedBytes): AwaitedMap {
  try {
    const [source, target] = JSON.parse(wantedMeshes(bytes)) as [WantedMesh, WantedMesh];
    const shown = (mesh: WantedMesh): WantedMesh => ({ ...mesh, name: shownName(mesh.name ?? '') || null });
    return { name, bytes, meshes: [shown(source), shown(target)] };
  } catch (thrown) {
    throw new FileRefused(fileSentence(name, failureOf(thrown)));
  }
}

/** The sides of the page that lack the map's mesh. */
export function missingOf(map: AwaitedMap, meshes: State['meshes']): readonly Side[] {
  return SIDES.filter((side) => !isIt(map.meshes[side], meshes[side]));
}

/** The only side of a map that a mesh fits; `null` where it fits neither or both. */
export function sideIn(map: AwaitedMap, file: MeshFile): Side | null {
  const [isSource, isTarget] = map.meshes.map((wanted) => isIt(wanted, file));
  return isSource === isTarget ? null : isSource === true ? 0 : 1;
}

/**
 * Whether a map can be opened now, or waits for meshes: it can wait for a side that is empty or shows a demo. `before` is the page without
 * the meshes that come with the map. Throws {@link FileRefused} where the page has another mesh.
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
