/** Which mirror planes are in use, and which pairs are each other's mirror image. */
import type { Pair, Side, Taking } from '../landmarks.ts';
import type { MeshPlane, Plane } from './left-right.ts';
import type { State } from './state.ts';

/** The pairs of the two points of a side that were placed last; `null` where there are not two. */
export function lastTwo({ pairs }: Pick<State, 'pairs'>, side: Side): readonly [Pair, Pair] | null {
  const [b, a] = pairs.filter(({ points }) => points[side] !== null).toSorted((p, q) => q.id - p.id);
  return a === undefined || b === undefined ? null : [a, b];
}

/** The plane that now gives the points of a side their mirror images; `null` for none. */
export function planeInUse({ leftRight, meshes }: Pick<State, 'leftRight' | 'meshes'>, side: Side): Plane | null {
  const known = leftRight.planes[side];
  if (!leftRight.isOn || known?.of !== meshes[side] || known.answer === null || known.answer === 'awaited') {
    return null;
  }
  return known.choice !== 'found' || known.answer.fits ? known.answer.plane : null;
}

/** How the suggestions of a side that look alike are taken. */
export function takingOn(state: Pick<State, 'leftRight' | 'meshes'>, side: Side): Taking {
  return planeInUse(state, side) === null ? 'alone' : 'together';
}

/** The state after a plane of a side was asked for or found. */
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

/** The state in which two pairs are each other's mirror image; unchanged where one of them has another one. */
export function withTwins(state: State, a: number, b: number): State {
  const isFree = a !== b && twinOf(state, a) === null && twinOf(state, b) === null;
  return isFree ? { ...state, leftRight: { ...state.leftRight, twins: [...state.leftRight.twins, [a, b]] } } : state;
}
