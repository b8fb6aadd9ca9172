/** The stages of two meshes on their way to their landmarks, side by side. */
import type { Simplification, Simplifications } from '../compute/watch-messages.ts';
import type { StageTriangles } from './hands.ts';

/** How many stages the way of the larger mesh has. */
export function stageCount(found: Simplifications): number {
  return Math.max(...found.map(({ counts }) => counts.length));
}

/** The stage of one mesh: both begin and end together, the one with fewer stages rests now and then. */
function own({ counts }: Simplification, stage: number, last: number): number {
  return last === 0 ? 0 : Math.round((stage / last) * (counts.length - 1));
}

/** How many triangles a mesh has at a stage. */
export function countAt(found: Simplification, stage: number, last: number): number {
  return found.counts[own(found, stage, last)] ?? 0;
}

/** What a mesh is at a stage. */
export function stageAt(found: Simplification, stage: number, last: number): StageTriangles {
  const { positions, triangles, counts } = found;
  const at = own(found, stage, last);
  const begin = counts.subarray(0, at).reduce((sum, count) => sum + count, 0);
  return { positions, triangles: triangles.subarray(3 * begin, 3 * (begin + (counts[at] ?? 0))) };
}
