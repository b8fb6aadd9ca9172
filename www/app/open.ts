/** Brings meshes and landmarks onto the page: files that were chosen or dropped, demos, links to demos. */
import type { NamedBytes } from '../files.ts';
import type { Opening } from '../opening.ts';
import { FileRefused, landmarkFile, meshFile } from '../files.ts';
import type { Arrivals } from '../opening.ts';
import { arrivalsOf, meshesAmong, openingOf } from '../opening.ts';
import type { Side } from '../landmarks.ts';
import { SENTENCES } from '../messages.ts';
import type { DemoFiles } from '../reading/messages.ts';
import type { FileReader } from '../reading/reader.ts';
import { readMesh } from '../reading/reader.ts';
import type { Event } from '../store/events.ts';
import { heldMeshes } from '../store/history.ts';
import type { Demo, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import type { Maps } from './maps.ts';
import { perform } from './task.ts';

/** The largest file that is opened, in bytes. The core's memory ends at 4 GiB, and holds a file beside the mesh that is made of it. */
export const LARGEST_FILE = 2 ** 30;

/** The bytes of a file. Throws {@link FileRefused}. */
export async function bytesOf(file: File): Promise<NamedBytes> {
  if (file.size > LARGEST_FILE) {
    throw new FileRefused(`${file.name} ${SENTENCES.tooLarge}`);
  }
  if (file.size === 0) {
    throw new FileRefused(`${file.name} ${SENTENCES.empty}`);
  }
  try {
    return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  } catch {
    throw new FileRefused(`${file.name}: ${SENTENCES.unreadable}`);
  }
}

/** Reads files, and sorts them into meshes, landmarks, maps and others. Throws {@link FileRefused}. */
async function arrivals(reader: FileReader, files: readonly NamedBytes[], signal: AbortSignal): Promise<Arrivals> {
  const sorted = await reader.ask({ kind: 'sort', files }, signal);
  const meshes = meshesAmong(sorted);
  const readings = await Promise.all(meshes.map((file) => readMesh(reader, file, {}, signal)));
  return arrivalsOf(sorted, readings);
}

/** What opening files needs: the worker that reads them, and the opener of maps. */
export interface Openers {
  readonly reader: FileReader;
  readonly maps: Pick<Maps, 'open' | 'openOfProject'>;
}

/** Opens files; `side` is the view they were dropped on or chosen for. */
export async function openFiles(store: Store, { reader, maps }: Openers, files: readonly File[], side: Side | null): Promise<void> {
  if (store.state.job.kind === 'running') {
    store.dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
    return;
  }
  store.dispatch({ kind: 'error-closed' });
  const later: { map: Opening['map'] } = { map: null };
  await perform(
    store,
    'Reading the files…',
    async (signal) => arrivals(reader, await Promise.all(files.map(bytesOf)), signal),
    (arrived) => {
      const opening = openingOf(arrived, side, store.state);
      store.dispatch(...opening.events);
      later.map = opening.map;
    },
  );
  if (later.map !== null) {
    await maps.open(later.map, 'brought');
  }
}

/** Builds a demo. Throws {@link FileRefused} where there is none. */
export async function buildDemo(reader: FileReader, { id }: Pick<Demo, 'id'>, signal: AbortSignal): Promise<DemoFiles> {
  const built = await reader.ask({ kind: 'demo', id }, signal);
  if (built === null) {
    throw new FileRefused(SENTENCES.noDemo);
  }
  return built;
}

/** The events that bring a demo onto the page. */
export function demoEvents(demo: Demo, built: DemoFiles): Event[] {
  const [source, target] = [meshFile(built.meshes[0]), meshFile(built.meshes[1])];
  const landmarks = landmarkFile(built.landmarks);
  return [
    { kind: 'mesh', side: 0, file: source },
    { kind: 'mesh', side: 1, file: target },
    { kind: 'landmarks', file: landmarks },
    { kind: 'demo', demo },
  ];
}

/** Opens a demo; returns `false` where it does not come onto the page, because there is none or because something else came meanwhile. */
export async function openDemo(store: Store, reader: FileReader, id: string): Promise<boolean> {
  const demo = store.state.demos.find((candidate) => candidate.id === id);
  if (demo === undefined) {
    store.dispatch({ kind: 'error', sentence: SENTENCES.noDemo });
    return false;
  }
  if (store.state.job.kind === 'running') {
    store.dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
    return false;
  }
  const outcome = await perform(
    store,
    `Building the demo “${demo.title}”…`,
    (signal) => buildDemo(reader, demo, signal),
    (built) => {
      store.dispatch(...demoEvents(demo, built));
    },
  );
  return outcome === 'done';
}

/**
 * Keeps the demo's link in the address while the demo is on the page, and removes it when other meshes have come. A link that is being
 * received has the address to itself.
 */
export function followDemo(state: State, previous: State): void {
  if (previous.demo !== state.demo && state.receiving.kind === 'nothing') {
    showOwnLink(state);
  }
}

/** Writes the link of the demo on the page into the address, or removes it where there is no demo. */
export function showOwnLink({ demo }: Pick<State, 'demo'>): void {
  const link = demo === null ? '' : `#demo=${encodeURIComponent(demo.id)}`;
  history.replaceState(null, '', location.pathname + location.search + link);
}

/** Frees the core's memory of meshes that no step of the history leads back to. */
export function freeForgotten(state: State, previous: State): void {
  if (state.history === previous.history && state.meshes === previous.meshes) {
    return;
  }
  const held = heldMeshes(state.history, state);
  for (const file of heldMeshes(previous.history, previous)) {
    if (!held.has(file)) {
      file.mesh.free();
    }
  }
}
