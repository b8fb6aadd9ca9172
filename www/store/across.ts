/** Which planes are in use, and which pairs are each other's mirror image. */
import type { Pair, Side } from '../landmarks.ts';
import type { MeshPlane, Plane } from './left-right.ts';
import type { State } from './state.ts';

/** Two points of a side, those that were placed last, with their pairs' numbers; `null` where there are not as many. */
export function lastTwo({ pairs }: Pick<State, 'pairs'>, side: Side): readonly [Pair, Pair] | null {
  const [b, a] = pairs.filter(({ points }) => points[side] !== null).toSorted((p, q) => q.id - p.id);
  return a === undefined || b === undefined ? null : [a, b];
}

/** The plane by which points of a side get their partners now; `null` for none. */
export function planeInUse({ leftRight, meshes }: Pick<State, 'leftRight' | 'meshes'>, side: Side): Plane | null {
  const known = leftRight.planes[side];
  if (!leftRight.isOn || known?.of !== meshes[side] || known.answer === null || known.answer === 'awaited') {
    return null;
  }
  return known.choice !== 'found' || known.answer.fits ? known.answer.plane : null;
}

/** A plane of a side is asked for or known. */
export function withPlane(state: State, side: Side, plane: MeshPlane): State {
  if (state.meshes[side] !== plane.of) {
    return state;
  }
  const [source, target] = state.leftRight.planes;
  const planes = side === 0 ? ([plane, target] as const) : ([source, plane] as const);
  return { ...state, leftRight: { ...state.leftRight, planes } };
}

/** The pair that is a pair's mirror image; `null` where it has none. */
export function twinOf({ leftRight, pairs }: Pick<State, 'leftRight' | 'pairs'>, id: number): Pair | null {
  const present = ([a, b]: readonly [number, number]): Pair | null =>
    pairs.find((pair) => (a === id && pair.id === b) || (b === id && pair.id === a)) ?? null;
  return leftRight.twins.map(present).find((pair) => pair !== null) ?? null;
}

/** Two pairs are each other's mirror image from now on, where neither has another one. */
export function withTwins(state: State, a: number, b: number): State {
  const isFree = a !== b && twinOf(state, a) === null && twinOf(state, b) === null;
  return isFree ? { ...state, leftRight: { ...state.leftRight, twins: [...state.leftRight.twins, [a, b]] } } : state;
}
