/** The landmarks of a state as a file. */
import type { LandmarkFile } from '../landmarks.ts';
import type { State } from './state.ts';

/** The file's name without folders. */
export function baseName(path: string): string {
  return path.slice(Math.max(path.lastIndexOf('/'), path.lastIndexOf('\\')) + 1);
}

/** The landmark file of the state. */
export function landmarkFileOf(state: State): LandmarkFile {
  const [source, target] = state.meshes;
  return {
    ...(source === null ? {} : { source: source.name }),
    ...(target === null ? {} : { target: target.name }),
    pairs: state.pairs.map((pair) => pair.points),
    ...(state.pairs.some((pair) => pair.label !== '')
      ? { labels: state.pairs.map((pair) => pair.label) }
      : {}),
    ...(state.groundTruth === null ? {} : { ground_truth: state.groundTruth }),
  };
}
