/** Gathers meshes that come in several files or in a zip: all files that belong to a mesh become one file. */
import type { Unzipped } from 'fflate';
import { unzipSync } from 'fflate';
import { failureOf } from './compute/messages.ts';
import { fileSentence, missingParts, SENTENCES } from './messages.ts';
import type { NamedBytes } from './named-file.ts';
import { endingOf, FileRefused } from './named-file.ts';
import { meshParts, packMaterials, packMesh } from './wasm/page.js';

/** The endings of files that belong to a mesh and are not meshes themselves. */
const COMPANIONS = new Set(['mtl', 'png', 'jpg', 'jpeg', 'webp', 'bmp', 'tga', 'tif', 'tiff', 'bin', 'ktx2']);

/** What a file chooser accepts beside meshes: their parts, and zips. */
export const PART_ENDINGS = [...COMPANIONS, 'zip'].map((ending) => `.${ending}`).join(',');

/** The most bytes of a zip's unpacked content, and the largest ratio of these to the zip's own size. */
const LARGEST_CONTENT = 2 ** 30;
const LARGEST_RATIO = 200;
/** The content of a zip may always have this many bytes, whatever the ratio. */
const ALWAYS_ALLOWED = 2 ** 24;
const MOST_FILES = 1000;

function isZip({ bytes }: NamedBytes): boolean {
  return bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 || bytes[2] === 5);
}

/** Whether an entry of a zip is a file to look at: not a folder, and not one of the copies that macOS puts beside files. */
function isFile(path: string): boolean {
  return !path.endsWith('/') && !/(^|\/)(__MACOSX\/|\._|\.DS_Store$)/.test(path);
}

/** The files of a zip, by their paths in it. Sizes are compared with the limits before anything is unpacked. */
function filesOfZip(zip: NamedBytes): NamedBytes[] {
  let total = 0;
  let count = 0;
  const limit = Math.min(LARGEST_CONTENT, Math.max(ALWAYS_ALLOWED, LARGEST_RATIO * zip.bytes.length));
  const refuse = (sentence: string): never => {
    throw new FileRefused(`${zip.name}: ${sentence}`);
  };
  let files: Unzipped;
  try {
    files = unzipSync(zip.bytes, {
      filter: ({ name, originalSize }) => {
        count += 1;
        if (count > MOST_FILES) {
          refuse(SENTENCES.manyInZip);
        }
        if (!isFile(name)) {
          return false;
        }
        total += originalSize;
        return total > limit ? refuse(SENTENCES.largeZip) : true;
      },
    });
  } catch (thrown) {
    throw thrown instanceof FileRefused ? thrown : new FileRefused(`${zip.name}: ${SENTENCES.brokenZip}`);
  }
  return Object.entries(files).map(([name, bytes]) => ({ name, bytes }));
}

/** All files, with each zip replaced by its files. */
function unzipped(files: readonly NamedBytes[]): NamedBytes[] {
  return files.flatMap((file) => (isZip(file) ? filesOfZip(file) : [file]));
}

/** The file that `by` refers to under a name: by its path beside `by`, or else by its bare name. */
function called(name: string, by: NamedBytes, files: readonly NamedBytes[]): NamedBytes | null {
  const folder = by.name.slice(0, by.name.lastIndexOf('/') + 1);
  const path = folder + name.replace(/^\.\//, '');
  const bare = (path: string): string => path.slice(path.lastIndexOf('/') + 1);
  return files.find((file) => file.name === path) ?? files.find((file) => bare(file.name) === bare(name)) ?? null;
}

/** A mesh with the files that it names packed into it; the mesh itself where it names none. */
function packed(mesh: NamedBytes, files: readonly NamedBytes[]): NamedBytes {
  const parts = meshParts(mesh.bytes);
  const [buffers, images] = [parts.buffers(), parts.images()];
  parts.free();
  if (buffers.length === 0) {
    return mesh;
  }
  const found = new Map([...buffers, ...images].map((name) => [name, called(name, mesh, files)]));
  const missing = buffers.filter((name) => (found.get(name) ?? null) === null);
  if (missing.length > 0) {
    throw new FileRefused(missingParts(mesh.name, missing));
  }
  const there = [...found].flatMap(([name, file]) => (file === null ? [] : [[name, file.bytes] as const]));
  try {
    const bytes = packMesh(
      mesh.bytes,
      there.map(([name]) => name),
      there.map(([, content]) => content),
    );
    return { name: mesh.name.replace(/\.[^.]*$/, '.glb'), bytes };
  } catch (thrown) {
    throw new FileRefused(fileSentence(mesh.name, failureOf(thrown)));
  }
}

const PICTURES = new Set(['png', 'jpg', 'jpeg', 'webp']);
/** The endings of meshes that can have texture coordinates into a separate picture. */
const PICTURED = new Set(['obj', 'ply']);

function stem(path: string): string {
  return path.replace(/^.*\//, '').replace(/\.[^.]*$/, '');
}

/**
 * What is laid on a mesh: the materials that it names with their pictures, or the picture with the mesh's name, or the only picture beside
 * the only mesh.
 */
function pictureOf(mesh: NamedBytes, files: readonly NamedBytes[]): Uint8Array | null {
  if (!PICTURED.has(endingOf(mesh.name))) {
    return null;
  }
  const set = packMaterials(mesh.bytes, (name: string) => called(name, mesh, files)?.bytes);
  const [materials, found] = [set?.bytes() ?? null, set?.found() ?? 0];
  set?.free();
  if (found > 0) {
    return materials;
  }
  const pictures = files.filter(({ name }) => PICTURES.has(endingOf(name)));
  const isAlone = files.filter(({ name }) => PICTURED.has(endingOf(name))).length === 1;
  const alone = isAlone && pictures.length === 1 ? pictures[0] : undefined;
  return (pictures.find(({ name }) => stem(name) === stem(mesh.name)) ?? alone)?.bytes ?? materials;
}

/**
 * The files with zips unpacked and the parts of each mesh packed into it; names are without folders. A picture of an OBJ or PLY file stays
 * with that file. Throws {@link FileRefused}.
 */
export function gathered(given: readonly NamedBytes[]): NamedBytes[] {
  const files = unzipped(given);
  const wholes = files.filter(({ name }) => !COMPANIONS.has(endingOf(name)));
  if (wholes.length === 0 && files.length > 0) {
    throw new FileRefused(`${files[0]?.name ?? ''}: ${SENTENCES.partsAlone}`);
  }
  return wholes
    .map((file) => ({ ...packed(file, files), picture: pictureOf(file, files) }))
    .map(({ name, bytes, picture }) => ({
      name: name.slice(name.lastIndexOf('/') + 1),
      bytes,
      ...(picture === null ? {} : { picture }),
    }));
}
