/** The memory that a map takes, foretold from the sizes of its meshes. */
import type { State } from './state.ts';

/** In bytes: what any map may take, and what each triangle of both meshes adds. The module took 3.0 to 4.0 KiB for each (`docs/figures.md`). */
const LEAST = 64 * 2 ** 20;
const PER_FACE = 4 * 2 ** 10;
/** In bytes: what WebAssembly with 32-bit addresses can hold. */
export const MOST_MEMORY = 2 ** 32;

/** What a map of the meshes on the page may take, in bytes; 0 where one is missing. */
export function expectedMemory(state: State): number {
  const [source, target] = state.meshes;
  return source === null || target === null ? 0 : LEAST + PER_FACE * (source.faceCount + target.faceCount);
}

/** Whether a map of the meshes may take more than the page can have. */
export function mayExceedMemory(state: State): boolean {
  return expectedMemory(state) > MOST_MEMORY;
}
