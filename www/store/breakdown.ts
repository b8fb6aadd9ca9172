/** Failures that nobody foresaw: faults of the program or of the machine, and not of what the user gave. Each comes with a report to copy. */
import type { Failure } from '../compute/messages.ts';
import type { Job } from './job.ts';
import type { Work } from './work.ts';

/** One of them, with what the page did. */
export interface Breakdown {
  /** What the page says of it. */
  readonly sentence: string;
  readonly failure: Failure;
  /** The stage of the run and its share in percent; empty where there was no run. */
  readonly during: string;
}

/** Where the page is. */
export interface Surroundings {
  /** Its address; what comes behind `#` or `?` is the user's own. */
  readonly address: string;
  readonly browser: string;
}

const UNFORESEEN: ReadonlySet<string> = new Set(['trap', 'unknown', 'worker']);

/** The breakdown that a failure is, by what the page did until then; `null` where it is none. */
export function breakdownOf(job: Job, sentence: string, failure: Failure | undefined): Breakdown | null {
  if (failure === undefined || !UNFORESEEN.has(failure.code)) {
    return null;
  }
  const progress = job.kind === 'running' ? job.progress : null;
  return { sentence, failure, during: progress === null ? '' : `${progress.sentence}, ${Math.round(100 * progress.share)} %` };
}

/** What the page says of failures. */
interface Told {
  readonly breakdown: Breakdown | null;
  readonly error: string | null;
}

/** The breakdown that the sentence on the page tells of; `null` where it tells of none. */
export function toldBreakdown({ breakdown, error }: Told): Breakdown | null {
  return breakdown !== null && breakdown.sentence === error ? breakdown : null;
}

/** The report: sizes and options, but no names, no places and nothing of the files. */
export function breakdownReport({ meshes, pairs, options }: Work, { failure, during }: Breakdown, { address, browser }: Surroundings): string {
  const [source, target] = meshes.map((file) => (file === null ? 'none' : `${file.vertexCount} vertices, ${file.faceCount} triangles`));
  const lines: readonly (readonly [string, string])[] = [
    ['Failure', `${failure.code}: ${failure.message}`],
    ['During', during],
    ['Source', source ?? ''],
    ['Target', target ?? ''],
    ['Pairs', String(pairs.length)],
    ['Options', JSON.stringify(options)],
    ['Page', address.replace(/[#?].*$/su, '')],
    ['Browser', browser],
    ['Where', failure.stack ?? ''],
  ];
  const told = lines.filter(([, value]) => value !== '').map(([name, value]) => `${name}: ${value}`);
  return `${['Conemap broke off.', ...told].join('\n')}\n`;
}
