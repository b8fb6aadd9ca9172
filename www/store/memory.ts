/** The memory that a map needs, estimated from the sizes of its meshes. */
import type { State } from './state.ts';

/**
 * The memory that any map may need, in bytes, and what each triangle of both meshes adds. The module took 3.0 to 4.0 KiB for each triangle
 * (`docs/figures.md`).
 */
const LEAST = 64 * 2 ** 20;
const PER_FACE = 4 * 2 ** 10;
/** The most memory that WebAssembly with 32-bit addresses can have, in bytes. */
export const MOST_MEMORY = 2 ** 32;

/** The memory that a map of the meshes on the page may need, in bytes; 0 where a mesh is missing. */
export function expectedMemory(state: State): number {
  const [source, target] = state.meshes;
  return source === null || target === null ? 0 : LEAST + PER_FACE * (source.faceCount + target.faceCount);
}

/** Whether a map of the meshes may need more memory than the page can have. */
export function mayExceedMemory(state: State): boolean {
  return expectedMemory(state) > MOST_MEMORY;
}
