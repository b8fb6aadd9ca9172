/** The landmarks of a state as a landmark file. */
import type { LandmarkFile, Pair } from '../landmarks.ts';
import { wholePairs } from './order.ts';
import type { Work } from './work.ts';

/** The name of a file without its folders. */
export function baseName(path: string): string {
  return path.slice(Math.max(path.lastIndexOf('/'), path.lastIndexOf('\\')) + 1);
}

/** The radius within which a run may move the point of a pair on the target. */
function radiusOf({ radius, locked }: Pair): number {
  return locked ? 0 : (radius ?? 0);
}

/** The landmark file of the pairs that have both points; a file cannot hold half pairs. */
export function landmarkFileOf(work: Pick<Work, 'meshes' | 'pairs' | 'groundTruth'>): LandmarkFile {
  const [source, target] = work.meshes;
  const pairs = wholePairs(work);
  return {
    ...(source === null ? {} : { source: source.name }),
    ...(target === null ? {} : { target: target.name }),
    pairs: pairs.map(({ points }) => points),
    ...(pairs.some((pair) => radiusOf(pair) > 0) ? { radii: pairs.map(radiusOf) } : {}),
    ...(pairs.some(({ label }) => label !== '') ? { labels: pairs.map(({ label }) => label) } : {}),
    ...(work.groundTruth === null ? {} : { ground_truth: work.groundTruth }),
  };
}
