/** Reads and writes the landmark files of many programs. */
import { failureOf } from './compute/messages.ts';
import type { LandmarkFile, Side, SurfacePoint } from './landmarks.ts';
import { fileSentence, failureSentence } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { FileRefused } from './named-file.ts';
import { baseName } from './store/landmark-file.ts';
import type { LandmarkContent, LandmarkFormatInfo, LoadedMesh } from './wasm/page.js';
import {
  landmarkContent,
  landmarkFormats,
  readLandmarkPairs,
  readLandmarks,
  readLandmarkSide,
  writeLandmarkPairs,
  writeLandmarkSide,
} from './wasm/page.js';

/** A landmark of one mesh. */
export interface SideMark {
  readonly label: string;
  /** The place of the landmark; `null` where the file says that it was not placed. */
  readonly point: SurfacePoint | null;
  /** The distance of the file's point from the surface, in the units of the mesh. */
  readonly distance: number;
}

/** The landmarks of one mesh, and remarks about them. */
export interface SideRead {
  readonly marks: readonly SideMark[];
  readonly remarks: readonly string[];
}

/** Pairs by the meshes' own numbers of vertices and faces, and remarks about their file. */
export interface OwnFileRead {
  readonly file: LandmarkFile;
  readonly remarks: readonly string[];
}

/** The landmarks of both meshes, and remarks about them. */
export interface PairsRead {
  readonly file: LandmarkFile;
  /** The distance of both points of each pair from their surfaces, in the units of the meshes. */
  readonly distances: readonly (readonly [number, number])[];
  readonly remarks: readonly string[];
}

/** The formats of landmark files. */
export function formatList(): readonly LandmarkFormatInfo[] {
  return JSON.parse(landmarkFormats()) as LandmarkFormatInfo[];
}

/** An error of the core as the refusal of a file. */
function refusal(file: NamedBytes | undefined, thrown: unknown): FileRefused {
  const failure = failureOf(thrown);
  return new FileRefused(file === undefined ? failureSentence(failure) : fileSentence(file.name, failure));
}

/** The one of several files that the core's error names; `undefined` for none or all. */
function blamed(files: readonly NamedBytes[], thrown: unknown): NamedBytes | undefined {
  try {
    const value: unknown = typeof thrown === 'string' ? JSON.parse(thrown) : null;
    const isObject = typeof value === 'object' && value !== null;
    return isObject && 'file' in value && typeof value.file === 'number' ? files[value.file] : undefined;
  } catch {
    return undefined;
  }
}

/** What a file holds; `null` where it is not a landmark file. Throws {@link FileRefused} for one that cannot be read. */
export function contentOf(file: NamedBytes): LandmarkContent | null {
  try {
    return landmarkContent(file.name, file.bytes) ?? null;
  } catch (thrown) {
    throw refusal(file, thrown);
  }
}

/** Reads a file of the program's own format. */
export function ownFileRead(file: NamedBytes): OwnFileRead {
  try {
    return JSON.parse(readLandmarks(file.bytes)) as OwnFileRead;
  } catch (thrown) {
    throw refusal(file, thrown);
  }
}

/** The landmarks of a file of the program's own format. */
export function landmarkFile(file: NamedBytes): LandmarkFile {
  return ownFileRead(file).file;
}

/** Reads the landmarks of one mesh. */
export function sideRead(file: NamedBytes, mesh: LoadedMesh, side: Side): SideRead {
  try {
    return JSON.parse(readLandmarkSide(file.name, file.bytes, mesh, side)) as SideRead;
  } catch (thrown) {
    throw refusal(file, thrown);
  }
}

/** Reads the landmarks of both meshes from one file that holds both, or from the source's and the target's. */
export function pairsRead(files: readonly NamedBytes[], source: LoadedMesh, target: LoadedMesh): PairsRead {
  try {
    const names = files.map(({ name }) => name);
    const contents = files.map(({ bytes }) => bytes);
    return JSON.parse(readLandmarkPairs(names, contents, source, target)) as PairsRead;
  } catch (thrown) {
    throw refusal(blamed(files, thrown), thrown);
  }
}

/** A name without its folders and its ending. */
function stemOf(name: string): string {
  return name.replace(/^.*[/\\]/, '').replace(/\.(mrk\.)?[^.]*$/, '');
}

/**
 * Landmarks as files of a format: one where it holds both meshes, else one for each mesh, called after it. The landmark file
 * should name its meshes.
 */
export function filesOf(
  format: LandmarkFormatInfo,
  file: LandmarkFile,
  source: LoadedMesh,
  target: LoadedMesh,
): readonly NamedBytes[] {
  const bytes = new TextEncoder().encode(JSON.stringify(file));
  try {
    if (format.holds !== 'one') {
      return [{ name: `landmarks.${format.ending}`, bytes: writeLandmarkPairs(format.id, bytes, source, target) }];
    }
    const stems = [stemOf(file.source ?? 'source'), stemOf(file.target ?? 'target')] as const;
    const names = stems[0] === stems[1] ? ([`${stems[0]}-source`, `${stems[1]}-target`] as const) : stems;
    return [
      { name: `${names[0]}.${format.ending}`, bytes: writeLandmarkSide(format.id, bytes, source, 0) },
      { name: `${names[1]}.${format.ending}`, bytes: writeLandmarkSide(format.id, bytes, target, 1) },
    ];
  } catch (thrown) {
    throw refusal(undefined, thrown);
  }
}

/**
 * The meshes that a landmark file names and that are not those on the page, which are given by their names. Folders, endings and capitals
 * do not count.
 */
export function othersNamed({ source, target }: LandmarkFile, meshes: readonly (string | null)[]): readonly string[] {
  const stem = (name: string): string => stemOf(name).toLowerCase();
  return [source, target].flatMap((named, side) => {
    const present = meshes[side] ?? null;
    return named === undefined || stem(named) === '' || present === null || stem(named) === stem(present) ? [] : [baseName(named)];
  });
}

/** The mesh whose name is that of the landmark file; `null` where neither or both have it. */
export function sideCalledLike(file: NamedBytes, meshes: readonly (string | null)[]): Side | null {
  const stem = stemOf(file.name).toLowerCase();
  const [isSource, isTarget] = meshes.map((name) => name !== null && stemOf(name).toLowerCase() === stem);
  return isSource === isTarget ? null : isSource === true ? 0 : 1;
}
