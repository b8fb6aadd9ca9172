/** The histories of vertices in a simplification: each goes onto another one, which goes onto another one, until a landmark. */
import type { Simplification } from '../compute/watch-messages.ts';

/** A step of a vertex's history. */
export interface Step {
  /** The vertex that stands for it from now on. */
  readonly vertex: number;
  /** The number of the collapse, from 1. */
  readonly collapse: number;
}

/** By vertex the collapse in which it went, from 0, or -1 where it stays. */
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

/** The vertex that is nearest to a place. */
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

/** The history of a vertex, in the order of its collapses; none of one that stays. */
export function historyOf(found: Simplification, vertex: number): readonly Step[] {
  const gone = goneOf(found);
  const steps: Step[] = [];
  for (let at = gone[vertex] ?? -1; at >= 0; at = gone[steps.at(-1)?.vertex ?? 0] ?? -1) {
    steps.push({ vertex: found.collapses[2 * at + 1] ?? 0, collapse: at + 1 });
  }
  return steps;
}

/** The places that a vertex takes, its own first, three numbers each. */
export function trailOf({ positions }: Simplification, vertex: number, history: readonly Step[]): Float32Array {
  return Float32Array.from([vertex, ...history.map((step) => step.vertex)].flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]));
}
