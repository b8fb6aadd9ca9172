/** The stages of two meshes on their way to their landmarks, played side by side. */
import type { Simplification, Simplifications } from '../compute/watch-messages.ts';
import type { StageTriangles } from './hands.ts';

/** The number of stages of the mesh that has more. */
export function stageCount(found: Simplifications): number {
  return Math.max(...found.map(({ counts }) => counts.length));
}

/** The stage of one mesh: both begin and end together, and the one with fewer stages pauses now and then. */
function own({ counts }: Simplification, stage: number, last: number): number {
  return last === 0 ? 0 : Math.round((stage / last) * (counts.length - 1));
}

/** The number of triangles of a mesh at a stage. */
export function countAt(found: Simplification, stage: number, last: number): number {
  return found.counts[own(found, stage, last)] ?? 0;
}

/** The triangles of a mesh at a stage. */
export function stageAt(found: Simplification, stage: number, last: number): StageTriangles {
  const { positions, triangles, counts } = found;
  const at = own(found, stage, last);
  const begin = counts.subarray(0, at).reduce((sum, count) => sum + count, 0);
  return { positions, triangles: triangles.subarray(3 * begin, 3 * (begin + (counts[at] ?? 0))) };
}
