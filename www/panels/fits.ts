/** Judges how well each landmark pair fits. */
import { isSamePoint, isWhole, SIDES } from '../landmarks.ts';
import type { Pair } from '../landmarks.ts';
import type { State } from '../store/state.ts';

/** How well a pair fits; `new` where no run has judged the pair as it is now. */
export type Fit = 'new' | 'fits' | 'doubtful' | 'missing';

/** Each pair's fit by its id. */
export function fitsOf({ pairs, findings, result }: Pick<State, 'pairs' | 'findings' | 'result'>): ReadonlyMap<number, Fit> {
  const doubtful = new Set(findings.flatMap((finding) => finding.ids));
  const judged = new Map(result?.inputs.pairs.map((pair) => [pair.id, pair]));
  const isJudged = (pair: Pair): boolean => {
    const before = judged.get(pair.id);
    return before !== undefined && SIDES.every((side) => isSamePoint(before.points[side], pair.points[side]));
  };
  return new Map(
    pairs.map((pair) => [
      pair.id,
      !isWhole(pair) ? 'missing' : doubtful.has(pair.id) ? 'doubtful' : isJudged(pair) ? 'fits' : 'new',
    ]),
  );
}
