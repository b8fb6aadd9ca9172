/**
 * The histories of vertices in a simplification: each vertex is collapsed onto another one, and that onto a further one, until a landmark
 * is reached.
 */
import type { Simplification } from '../compute/watch-messages.ts';

/** A step of a vertex's history. */
export interface Step {
  /** The vertex that stands for the first one from now on. */
  readonly vertex: number;
  /** The number of the collapse, from 1. */
  readonly collapse: number;
}

/** The number of the collapse, from 0, in which each vertex was removed; -1 where the vertex stays. */
const GONE = new WeakMap<Simplification, Int32Array>();

function goneOf(found: Simplification): Int32Array {
  const known = GONE.get(found);
  if (known !== undefined) {
    return known;
  }
  const gone = new Int32Array(found.positions.length / 3).fill(-1);
  for (let at = 0; at < found.collapses.length; at += 2) {
    gone[found.collapses[at] ?? 0] = at / 2;
  }
  GONE.set(found, gone);
  return gone;
}

/** The vertex nearest to a place. */
export function nearestVertex({ positions }: Simplification, [x, y, z]: readonly [number, number, number]): number {
  let [best, least] = [0, Infinity];
  for (let at = 0; at < positions.length; at += 3) {
    const [dx, dy, dz] = [(positions[at] ?? 0) - x, (positions[at + 1] ?? 0) - y, (positions[at + 2] ?? 0) - z];
    const square = dx * dx + dy * dy + dz * dz;
    if (square < least) {
      [best, least] = [at / 3, square];
    }
  }
  return best;
}

/** The history of a vertex, in the order of its collapses; empty for a vertex that stays. */
export function historyOf(found: Simplification, vertex: number): readonly Step[] {
  const gone = goneOf(found);
  const steps: Step[] = [];
  for (let at = gone[vertex] ?? -1; at >= 0; at = gone[steps.at(-1)?.vertex ?? 0] ?? -1) {
    steps.push({ vertex: found.collapses[2 * at + 1] ?? 0, collapse: at + 1 });
  }
  return steps;
}

/** The positions of a vertex and of those that stand for it after each collapse, three numbers each. */
export function trailOf({ positions }: Simplification, vertex: number, history: readonly Step[]): Float32Array {
  return Float32Array.from([vertex, ...history.map((step) => step.vertex)].flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]));
}
