/** Brings meshes and landmarks onto the page: files that were chosen or dropped, demos, links to demos. */
import type { NamedBytes } from '../files.ts';
import type { Opening } from '../opening.ts';
import { FileRefused, landmarkFile, meshFile } from '../files.ts';
import { openingOf } from '../opening.ts';
import type { Side } from '../landmarks.ts';
import { SENTENCES } from '../messages.ts';
import type { Event } from '../store/events.ts';
import { heldMeshes } from '../store/history.ts';
import type { Demo, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { buildDemo } from '../wasm/conemap.js';
import type { Maps } from './maps.ts';
import { perform } from './task.ts';

/** In bytes. The core's memory ends at 4 GiB, and holds a file beside the mesh that is made of it. */
const LARGEST_FILE = 2 ** 30;

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

/** Opens files; `side` is the view they were dropped on or chosen for. */
export async function openFiles(store: Store, maps: Maps, files: readonly File[], side: Side | null): Promise<void> {
  const { ready, job } = store.state;
  if (!ready) {
    return;
  }
  if (job.kind === 'running') {
    store.dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
    return;
  }
  store.dispatch({ kind: 'error-closed' });
  const later: { map: Opening['map'] } = { map: null };
  await perform(
    store,
    'Reading the files…',
    () => Promise.all(files.map(bytesOf)),
    (named) => {
      const opening = openingOf(named, side, store.state);
      store.dispatch(...opening.events);
      later.map = opening.map;
    },
  );
  if (later.map !== null) {
    await maps.open(later.map, 'brought');
  }
}

/** The events that bring a demo onto the page. */
export function demoEvents(demo: Demo): Event[] {
  const built = buildDemo(demo.id);
  if (built === undefined) {
    throw new FileRefused(SENTENCES.noDemo);
  }
  const source = meshFile({ name: `${demo.id}-source.obj`, bytes: built.source() });
  const target = meshFile({ name: `${demo.id}-target.obj`, bytes: built.target() });
  const landmarks = landmarkFile({ name: `${demo.id}.json`, bytes: built.landmarks() });
  built.free();
  return [
    { kind: 'mesh', side: 0, file: source },
    { kind: 'mesh', side: 1, file: target },
    { kind: 'landmarks', file: landmarks },
    { kind: 'demo', demo },
  ];
}

/** Opens a demo; `false` where it does not come onto the page, because there is none or because of something else that came. */
export async function openDemo(store: Store, id: string): Promise<boolean> {
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
    () => demo,
    () => {
      store.dispatch(...demoEvents(demo));
    },
  );
  return outcome === 'done';
}

/** Keeps the demo's link in the address while the demo is on the page, and takes it out when other meshes have come. */
export function followDemo(state: State, previous: State): void {
  if (previous.demo !== state.demo) {
    showOwnLink(state);
  }
}

/** Puts the link of the demo on the page into the address, or none. */
export function showOwnLink({ demo }: Pick<State, 'demo'>): void {
  const link = demo === null ? '' : `#demo=${encodeURIComponent(demo.id)}`;
  history.replaceState(null, '', location.pathname + location.search + link);
}

/** Gives back the core's memory of meshes that no step leads back to. */
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
