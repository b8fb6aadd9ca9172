/** Converts work between the page's state and the form that links and projects have. */
import type { NamedBytes } from '../files.ts';
import { areMarksGood, checkFit, FileRefused, meshFile } from '../files.ts';
import { SENTENCES } from '../messages.ts';
import type { SentWork } from '../send/schema.ts';
import type { ReadFile } from '../reading/messages.ts';
import type { FileReader } from '../reading/reader.ts';
import { readMesh } from '../reading/reader.ts';
import type { Event } from '../store/events.ts';
import type { Allowed } from '../store/refused.ts';
import type { Demo, MeshFile, State, Work } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { DemoMesh } from '../store/work.ts';

/** A mesh that comes with a link or project. */
export interface ArrivingMesh {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** Where it was loaded from; `null` where it was given by hand. */
  readonly address: string | null;
  /** The demo that it was built for. */
  readonly ofDemo?: DemoMesh;
  /** The picture or materials that came with it. */
  readonly picture?: Uint8Array;
}

/** The work on the page and how it is viewed, without the meshes. */
export function sentWorkOf({ pairs, up, groundTruth, options, ui }: State): SentWork {
  return {
    pairs: pairs.map(({ number, points, label, locked, radius }) => ({ number, points, label, locked, ...(radius === undefined ? {} : { radius }) })),
    up,
    groundTruth,
    options,
    cameras: ui.cameras,
    style: ui.style,
  };
}

/** An arriving mesh as a file. */
function named({ name, bytes, address, ofDemo, picture }: ArrivingMesh): NamedBytes {
  return {
    name,
    bytes,
    ...(address === null ? {} : { address }),
    ...(ofDemo === undefined ? {} : { ofDemo }),
    ...(picture === undefined ? {} : { picture }),
  };
}

/** Reads arriving meshes. Meshes of work that was on a page before are allowed every repair that they were given there. */
export async function readArriving(
  reader: FileReader,
  [source, target]: readonly [ArrivingMesh | null, ArrivingMesh | null],
  allowed: Allowed,
  signal: AbortSignal,
): Promise<readonly [ReadFile | null, ReadFile | null]> {
  const read = async (mesh: ArrivingMesh | null): Promise<ReadFile | null> => {
    const file = mesh && named(mesh);
    return file && { file, reading: await readMesh(reader, file, allowed, signal) };
  };
  return Promise.all([read(source), read(target)]);
}

/** Gives meshes that were read to `work`; where that fails, the core's memory of them is freed. */
export function withMeshes<T>(read: readonly [ReadFile | null, ReadFile | null], work: (meshes: Work['meshes']) => T): T {
  const loaded: (MeshFile | null)[] = [];
  try {
    for (const mesh of read) {
      loaded.push(mesh && meshFile(mesh));
    }
    return work([loaded[0] ?? null, loaded[1] ?? null]);
  } catch (thrown) {
    for (const mesh of loaded) {
      mesh?.mesh.free();
    }
    throw thrown;
  }
}

/**
 * Puts work that was sent onto the page, as one step. `origin` names the link or file in the sentence that is shown where a point does not
 * belong to the meshes.
 */
export function place(store: Store, origin: string, sent: SentWork, meshes: Work['meshes'], demo: Demo | null): void {
  const work: Work = {
    meshes,
    up: sent.up,
    demo,
    pairs: sent.pairs.map((pair, index) => ({ ...pair, id: index + 1 })),
    named: [meshes[0]?.name ?? null, meshes[1]?.name ?? null],
    groundTruth: sent.groundTruth,
    options: sent.options,
  };
  const ui = { style: sent.style, cameras: sent.cameras };
  const events: Event[] = [{ kind: 'received', work, ui }];
  checkFit({ name: origin }, events, store.state);
  // The core checks pairs that have both points; the points of half pairs must belong to the meshes, too.
  if (!areMarksGood(work)) {
    throw new FileRefused(`${origin}: ${SENTENCES.badPoint}`);
  }
  store.dispatch(...events);
}
