/**
 * The project file, `.conemap.zip`: an archive of both meshes byte for byte, the work on them, and the map where there is one. Its file
 * `conemap.json` lists the content, and is what the page reads; `landmarks.json` beside it is for other programs.
 */
import * as v from 'valibot';
import type { ProjectFault } from '../messages.ts';
import type { DemoMesh } from '../store/work.ts';
import { addressOf, LONGEST_ADDRESS, shownName } from './address.ts';
import type { Archiver, Entries } from './archive.ts';
import { ArchiveRefused, isArchive, readArchive } from './archive.ts';
import { hashOf } from './hash.ts';
import type { SentWork } from './schema.ts';
import { SentWorkSchema, Text } from './schema.ts';

export const PROJECT_ENDING = '.conemap.zip';

/** The version that is written; files of higher versions are not read. */
const VERSION = 1;
const MANIFEST = 'conemap.json';
const LANDMARKS = 'landmarks.json';
const MAP = 'map.conemap';
const REPORT = 'report.json';
/** The most bytes of the manifest: some 100 for each of 10,000 pairs. */
const LARGEST_MANIFEST = 4_000_000;

/** A mesh of a project. */
export interface ProjectMesh {
  readonly name: string;
  /** The bytes of the file as it was given. */
  readonly bytes: Uint8Array;
  /** The address from which the mesh was loaded; `null` where it was given by hand. */
  readonly address: string | null;
  /** The demo that it was built for; missing for other files. */
  readonly ofDemo?: DemoMesh;
  /** The picture or materials that came with it; missing where its own file holds everything. */
  readonly picture?: Uint8Array;
}

/** What a project file holds. */
export interface Project {
  readonly meshes: readonly [ProjectMesh | null, ProjectMesh | null];
  readonly work: SentWork;
  /** The map file and the report of its run; `null` where there is no map. */
  readonly result: { readonly map: Uint8Array | null; readonly report: string } | null;
}

/** The error of a project file that is not opened. */
export class ProjectRefused extends Error {
  readonly fault: ProjectFault;

  constructor(fault: ProjectFault) {
    super(fault);
    this.fault = fault;
  }
}

const MeshEntry = v.nullable(
  v.object({
    name: v.pipe(v.string(), v.minLength(1), v.maxLength(1000)),
    entry: v.pipe(v.string(), v.regex(/^(?:source|target)\/[^/\\]+$/)),
    /** The SHA-256 hash of the bytes in base64url; `null` where the page could not compute it. */
    hash: v.nullable(v.pipe(v.string(), v.regex(/^[\w-]{43}$/))),
    address: v.nullable(v.pipe(v.string(), v.maxLength(LONGEST_ADDRESS))),
    picture: v.exactOptional(v.picklist(['pictures/source', 'pictures/target'])),
    ofDemo: v.exactOptional(v.object({ id: v.pipe(Text, v.minLength(1)), side: v.picklist([0, 1]) })),
  }),
);
type MeshEntry = v.InferOutput<typeof MeshEntry>;

const Versioned = v.object({ format: v.literal('conemap-project'), version: v.pipe(v.number(), v.integer(), v.minValue(1)) });
const Manifest = v.object({
  ...Versioned.entries,
  meshes: v.strictTuple([MeshEntry, MeshEntry]),
  work: SentWorkSchema,
  /** The files of the result that the archive has. */
  result: v.nullable(v.object({ map: v.nullable(v.literal(MAP)), report: v.literal(REPORT) })),
});
type Manifest = v.InferOutput<typeof Manifest>;

function entryOf(folder: string, { name }: ProjectMesh): string {
  return `${folder}/${shownName(name).replace(/[:*?"<>|]/g, '_') || 'mesh'}`;
}

async function meshEntry(folder: 'source' | 'target', mesh: ProjectMesh | null): Promise<MeshEntry> {
  if (mesh === null) {
    return null;
  }
  const picture = mesh.picture === undefined ? {} : ({ picture: `pictures/${folder}` } as const);
  const ofDemo = mesh.ofDemo === undefined ? {} : { ofDemo: mesh.ofDemo };
  return { name: mesh.name, entry: entryOf(folder, mesh), hash: await hashOf(mesh.bytes), address: mesh.address, ...picture, ...ofDemo };
}

async function entriesOf(project: Project, landmarks: string): Promise<Entries> {
  const { meshes, work, result } = project;
  const [source, target] = [await meshEntry('source', meshes[0]), await meshEntry('target', meshes[1])];
  const manifest: Manifest = {
    format: 'conemap-project',
    version: VERSION,
    meshes: [source, target],
    // The lists of the schema's type are not read-only; these lists are never written to.
    work: work as Manifest['work'],
    result: result === null ? null : { map: result.map === null ? null : MAP, report: REPORT },
  };
  const text = new TextEncoder();
  const entries: Record<string, Uint8Array> = {
    [MANIFEST]: text.encode(JSON.stringify(manifest, null, 1)),
    [LANDMARKS]: text.encode(landmarks),
  };
  [source, target].forEach((entry, side) => {
    const mesh = meshes[side];
    if (entry !== null && mesh !== null && mesh !== undefined) {
      entries[entry.entry] = mesh.bytes;
      if (entry.picture !== undefined && mesh.picture !== undefined) {
        entries[entry.picture] = mesh.picture;
      }
    }
  });
  if (result !== null) {
    entries[REPORT] = text.encode(result.report);
    if (result.map !== null) {
      entries[MAP] = result.map;
    }
  }
  return entries;
}

function refusal(thrown: unknown): unknown {
  return thrown instanceof ArchiveRefused ? new ProjectRefused(thrown.fault) : thrown;
}

function manifestBytes(archive: Uint8Array): Uint8Array | undefined {
  try {
    return readArchive(archive, [MANIFEST], LARGEST_MANIFEST)[MANIFEST];
  } catch (thrown) {
    if (thrown instanceof ArchiveRefused && thrown.fault === 'too-large') {
      throw new ProjectRefused('damaged');
    }
    throw refusal(thrown);
  }
}

function parsed(bytes: Uint8Array): unknown {
  try {
    return JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes)) as unknown;
  } catch {
    throw new ProjectRefused('damaged');
  }
}

/** Whether these bytes are an archive that calls itself a project, complete or not. */
export function isProject(bytes: Uint8Array): boolean {
  try {
    return isArchive(bytes) && manifestBytes(bytes) !== undefined;
  } catch {
    return false;
  }
}

function manifestOf(archive: Uint8Array): Manifest {
  const bytes = manifestBytes(archive);
  if (bytes === undefined) {
    throw new ProjectRefused('no-project');
  }
  const value = parsed(bytes);
  const versioned = v.safeParse(Versioned, value);
  if (!versioned.success) {
    throw new ProjectRefused('no-project');
  }
  if (versioned.output.version > VERSION) {
    throw new ProjectRefused('newer');
  }
  const manifest = v.safeParse(Manifest, value);
  if (!manifest.success) {
    throw new ProjectRefused('damaged');
  }
  return manifest.output;
}

async function meshOf(entry: MeshEntry, files: Entries): Promise<ProjectMesh | null> {
  if (entry === null) {
    return null;
  }
  const bytes = files[entry.entry];
  if (bytes === undefined) {
    throw new ProjectRefused('mesh-missing');
  }
  const hash = entry.hash === null ? null : await hashOf(bytes);
  if (hash !== null && hash !== entry.hash) {
    throw new ProjectRefused('mesh-changed');
  }
  const address = entry.address === null ? 'no-address' : addressOf(entry.address, new URL('https://none.invalid/'));
  // A mesh whose picture is missing is shown without it.
  const picture = entry.picture === undefined ? undefined : files[entry.picture];
  return {
    name: shownName(entry.name),
    bytes,
    address: typeof address === 'string' ? null : address.url,
    ...(picture === undefined ? {} : { picture }),
    ...(entry.ofDemo === undefined ? {} : { ofDemo: entry.ofDemo }),
  };
}

/**
 * The project in an archive; the array of its bytes is emptied by this. The files of a result are taken as they are, and checked when they
 * are opened. Throws {@link ProjectRefused}.
 */
export async function readProject(archive: Uint8Array, archiver: Archiver): Promise<Project> {
  const { meshes, work, result } = manifestOf(archive);
  const parts = meshes.flatMap((mesh) => [mesh?.entry, mesh?.picture]);
  const names = [...parts, result?.report, result?.map].filter((name) => typeof name === 'string');
  const files = await archiver.read(archive, names).catch((thrown: unknown) => {
    throw refusal(thrown);
  });
  const report = result === null ? undefined : files[result.report];
  const map = files[MAP];
  return {
    meshes: [await meshOf(meshes[0], files), await meshOf(meshes[1], files)],
    work,
    result: report === undefined ? null : { map: map ?? null, report: new TextDecoder().decode(report) },
  };
}

/** The project as one file; `landmarks` is the landmark file of the pairs that have both points. */
export async function writeProject(project: Project, landmarks: string, archiver: Archiver): Promise<Uint8Array<ArrayBuffer>> {
  return archiver.write(await entriesOf(project, landmarks));
}
