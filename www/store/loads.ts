/** Changes by files: a mesh of one side, a landmark file. */
import type { LandmarkFile, Side } from '../landmarks.ts';
import { forgotten } from './job.ts';
import { baseName } from './landmark-file.ts';
import { withPairs, withSuggestions } from './pairs.ts';
import type { MeshFile, State } from './state.ts';

/** A mesh in its place. Landmarks stay where the side was empty, and for the mesh that their file names. */
export function withMesh(state: State, side: Side, file: MeshFile): State {
  const meshes: [MeshFile | null, MeshFile | null] = [...state.meshes];
  const first = meshes[side] === null;
  meshes[side] = file;
  const keeps = first || state.named[side] === file.name;
  return {
    ...state,
    meshes,
    demo: null,
    pairs: keeps ? state.pairs : [],
    named: keeps ? state.named : [null, null],
    groundTruth: keeps ? state.groundTruth : null,
    pending: null,
    queue: [],
    suggestions: withSuggestions(state, side, []),
    history: [],
    result: null,
    findings: [],
    job: forgotten(state.job),
    style: { ...state.style, surface: 'shaded' },
  };
}

/** The pairs of a file in place of the present ones. */
export function withLandmarks(state: State, file: LandmarkFile): State {
  const pairs = file.pairs.map((points, index) => ({ points, label: file.labels?.[index] ?? '' }));
  return {
    ...withPairs(state, pairs),
    pending: null,
    queue: [],
    named: [
      file.source === undefined ? null : baseName(file.source),
      file.target === undefined ? null : baseName(file.target),
    ],
    groundTruth: file.ground_truth ?? null,
  };
}
