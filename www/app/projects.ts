/** Saves everything on the page as one project file, and opens such files. */
import { download } from '../dom.ts';
import type { NamedBytes } from '../files.ts';
import { FileRefused } from '../files.ts';
import { PROJECT_REFUSED } from '../messages.ts';
import { inWorker } from '../send/archiving.ts';
import type { Project, ProjectMesh } from '../send/project.ts';
import { PROJECT_ENDING, ProjectRefused, readProject, writeProject } from '../send/project.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { ALL_ALLOWED } from '../store/refused.ts';
import { shownResult } from '../store/staleness.ts';
import type { Demo, MeshFile, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { workName } from '../store/work.ts';
import type { Openers } from './open.ts';
import type { ArrivingMesh } from './sent-work.ts';
import { place, readArriving, sentWorkOf, withMeshes } from './sent-work.ts';
import { perform, performBeside } from './task.ts';

function projectMesh(file: MeshFile | null): ProjectMesh | null {
  if (file === null) {
    return null;
  }
  const { name, bytes, address = null, ofDemo, picture } = file;
  return { name, bytes, address, ...(ofDemo === undefined ? {} : { ofDemo }), ...(picture === undefined ? {} : { picture }) };
}

/** A mesh of a project as it comes onto the page; a demo that the page does not have is forgotten, since no link could bring it. */
export function arrivingOf(mesh: ProjectMesh | null, demos: readonly Pick<Demo, 'id'>[]): ArrivingMesh | null {
  if (mesh === null) {
    return null;
  }
  const { ofDemo, ...file } = mesh;
  return demos.some(({ id }) => id === ofDemo?.id) && ofDemo !== undefined ? { ...file, ofDemo } : file;
}

/** The state of the page as a project; the project has the map file where the result has one. */
function projectOf(state: State): Project {
  const result = shownResult(state);
  return {
    meshes: [projectMesh(state.meshes[0]), projectMesh(state.meshes[1])],
    work: sentWorkOf(state),
    result: result && { map: result.output.map, report: result.output.report },
  };
}

/** Saves the project under the names of its meshes. */
export async function saveProject(store: Store): Promise<void> {
  const { state } = store;
  await performBeside(
    store,
    'Packing the project…',
    () => writeProject(projectOf(state), JSON.stringify(landmarkFileOf(state), null, 1), inWorker),
    (bytes) => {
      download(`${workName(state.meshes.map((file) => file?.name ?? null))}${PROJECT_ENDING}`, 'application/zip', bytes);
    },
  );
}

async function projectIn({ name, bytes }: NamedBytes): Promise<Project> {
  try {
    return await readProject(bytes, inWorker);
  } catch (thrown) {
    throw thrown instanceof ProjectRefused ? new FileRefused(`${name}: ${PROJECT_REFUSED[thrown.fault]}`) : thrown;
  }
}

/** Brings a project onto the page, as one step, and then its map. */
export async function openProject(store: Store, { reader, maps }: Openers, file: NamedBytes): Promise<void> {
  const later: { map: Uint8Array | null } = { map: null };
  const outcome = await perform(
    store,
    'Unpacking the project…',
    async (signal) => {
      const project = await projectIn(file);
      const { demos } = store.state;
      const meshes = [arrivingOf(project.meshes[0], demos), arrivingOf(project.meshes[1], demos)] as const;
      return { ...project, read: await readArriving(reader, meshes, ALL_ALLOWED, signal) };
    },
    ({ read, work, result }) => {
      withMeshes(read, (loaded) => {
        place(store, file.name, work, loaded, null);
      });
      later.map = result?.map ?? null;
    },
  );
  if (outcome === 'done' && later.map !== null) {
    await maps.openOfProject({ name: file.name, bytes: later.map });
  }
}
