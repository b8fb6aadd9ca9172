/**
 * The only place that translates between the pairs of the page, which are identified by id and number, and those of a landmark file, a run
 * and its report, which are identified by their order among the pairs that have both points.
 */
import type { WholePair } from '../landmarks.ts';
import { isWhole } from '../landmarks.ts';
import { findingSentence, pairName } from '../messages.ts';
import type { Finding } from '../report.ts';
import type { Doubt } from './state.ts';
import type { Work } from './work.ts';

/** The pairs that files, runs and reports know, in their order. */
export function wholePairs(work: Pick<Work, 'pairs'>): readonly WholePair[] {
  return work.pairs.filter(isWhole);
}

/** The findings of a run as doubts about pairs of the page. */
export function doubtsOf(findings: readonly Finding[], inputs: Work): readonly Doubt[] {
  const whole = wholePairs(inputs);
  const name = (order: number): string => {
    const pair = whole[order];
    return pair === undefined ? String(order + 1) : pairName(pair);
  };
  return findings.map((finding) => ({
    ...finding,
    sentence: findingSentence(finding, name),
    ids: finding.pairs.flatMap((order) => whole[order]?.id ?? []),
  }));
}
