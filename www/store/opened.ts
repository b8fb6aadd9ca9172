/** Takes a map from a file as if it had just been made on the page. */
import type { RunOutput } from '../compute/messages.ts';
import type { LandmarkFile, Pair } from '../landmarks.ts';
import { isSamePoint, isWhole } from '../landmarks.ts';
import type { Report, RunOptions } from '../report.ts';
import { settled } from './job.ts';
import { doubtsOf } from './order.ts';
import type { Result, State } from './state.ts';
import type { Work } from './work.ts';
import { workOf } from './work.ts';

/** A map file that was read and checked. */
export interface OpenedMap {
  /** The name of the file. */
  readonly name: string;
  readonly isMirrored: boolean;
  readonly output: RunOutput;
  readonly report: Report;
  /** The landmarks and options that the map was made from; `options` is `null` where the file does not have them. */
  readonly landmarks: LandmarkFile;
  readonly options: RunOptions | null;
}

type Points = LandmarkFile['pairs'][number];

function arePoints(pair: Pair, [source, target]: Points): boolean {
  return isSamePoint(pair.points[0], source) && isSamePoint(pair.points[1], target);
}

/** Whether the pairs of a work that have both points are those of a file, in the same order. */
export function hasPairs({ pairs }: Pick<Work, 'pairs'>, file: LandmarkFile): boolean {
  const whole = pairs.filter(isWhole);
  return (
    whole.length === file.pairs.length &&
    whole.every((pair, index) => {
      const points = file.pairs[index];
      return points !== undefined && arePoints(pair, points);
    })
  );
}

/** The pairs that a map was made from: those of the page where the page has them, others with ids from `nextId` on. */
function pairsOf(state: State, { pairs, labels }: LandmarkFile): readonly Pair[] {
  return pairs.map((points, index) => {
    const present = state.pairs.find((pair) => arePoints(pair, points));
    return present ?? { id: state.nextId + index, number: index + 1, points, label: labels?.[index] ?? '', locked: false };
  });
}

/** The state with the content of a map file; `result` is returned separately, so that it can be shown like the result of a run. */
export function withOpened(state: State, map: OpenedMap): { readonly state: State; readonly result: Result } {
  const { name, isMirrored, output, report, landmarks, options } = map;
  const inputs = { ...workOf(state), pairs: pairsOf(state, landmarks), options: options ?? state.options };
  const result = { output, report, inputs, opened: { name, isMirrored } };
  const found = { doubts: doubtsOf(report.findings, inputs), inputs };
  const areThere = inputs.pairs.every((pair) => state.pairs.includes(pair));
  const nextId = areThere ? state.nextId : state.nextId + landmarks.pairs.length;
  return { state: { ...state, nextId, job: settled(state.job, true), found, awaited: null, error: null }, result };
}
