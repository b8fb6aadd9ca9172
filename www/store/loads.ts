/** Changes that files make: a mesh of one side, its mirror image, an exchange of both, a landmark file. */
import type { LandmarkFile, Pair, Side, SurfacePoint } from '../landmarks.ts';
import { baseName } from './landmark-file.ts';
import { withNewPairs } from './pairs.ts';
import type { State } from './state.ts';
import type { MeshFile } from './work.ts';
import { upOf } from './work.ts';

/** Both values, with the one of a side replaced. */
function withSide<T>(both: readonly [T, T], side: Side, one: T): readonly [T, T] {
  return side === 0 ? [one, both[1]] : [both[0], one];
}

/** The pairs without their points on one side; pairs without a point on the other side are removed. */
function halves(pairs: readonly Pair[], lost: Side): Pair[] {
  return pairs
    .map((pair): Pair => ({ ...pair, points: withSide(pair.points, lost, null) }))
    .filter(({ points }) => points.some((point) => point !== null));
}

/**
 * The state with a mesh on a side. The landmarks stay where the side was empty, and where their file names this mesh; otherwise the points
 * on the other side stay and wait for new partners, unless they belong to a demo.
 */
export function withMesh(state: State, side: Side, file: MeshFile): State {
  const keeps = state.meshes[side] === null || state.named[side] === file.name;
  const rest = state.demo === null ? halves(state.pairs, side) : [];
  return {
    ...state,
    meshes: withSide(state.meshes, side, file),
    up: withSide(state.up, side, upOf(file.name)),
    demo: null,
    pairs: keeps ? state.pairs : rest,
    named: keeps ? state.named : rest.length > 0 ? withSide(state.named, side, null) : [null, null],
    groundTruth: keeps ? state.groundTruth : null,
  };
}

/** The state with the target's mirror image as the target; the pairs stay, with their points on it. */
export function withMirrored(state: State, file: MeshFile, points: readonly (SurfacePoint | null)[]): State {
  return {
    ...state,
    meshes: withSide(state.meshes, 1, file),
    demo: null,
    pairs: state.pairs.map((pair, index) => ({ ...pair, points: withSide(pair.points, 1, points[index] ?? null) })),
    named: withSide(state.named, 1, file.name),
    groundTruth: null,
  };
}

/** The state with source and target exchanged, with everything that belongs to them. */
export function withSwap(state: State): State {
  const swapped = <T>([source, target]: readonly [T, T]): readonly [T, T] => [target, source];
  if (state.meshes.every((file) => file === null) && state.pairs.length === 0) {
    return state;
  }
  return {
    ...state,
    meshes: swapped(state.meshes),
    up: swapped(state.up),
    demo: null,
    pairs: state.pairs.map((pair) => ({ ...pair, points: swapped(pair.points) })),
    named: swapped(state.named),
  };
}

/** The state with the pairs of a file in place of the present ones. */
export function withLandmarks(state: State, file: LandmarkFile): State {
  const made = file.pairs.map((points, index) => {
    const radius = file.radii?.[index] ?? 0;
    return { points, label: file.labels?.[index] ?? '', ...(radius > 0 ? { radius } : {}) };
  });
  return {
    ...withNewPairs({ ...state, pairs: [] }, made),
    named: [
      file.source === undefined ? null : baseName(file.source),
      file.target === undefined ? null : baseName(file.target),
    ],
    groundTruth: file.ground_truth ?? null,
  };
}
