/** Breakdowns: failures of the program or the machine, not of what the user gave. Each comes with a report to copy. */
import type { Failure } from '../compute/messages.ts';
import type { Job } from './job.ts';
import type { Work } from './work.ts';

/** A breakdown, with what the page did then. */
export interface Breakdown {
  /** The sentence that the page shows about it. */
  readonly sentence: string;
  readonly failure: Failure;
  /** The stage of the run and its share in percent; empty where no run went on. */
  readonly during: string;
}

/** Where the page runs. */
export interface Surroundings {
  /** The page's address; what follows a `#` or `?` in it belongs to the user and is not reported. */
  readonly address: string;
  readonly browser: string;
}

const UNFORESEEN: ReadonlySet<string> = new Set(['trap', 'unknown', 'worker']);

/** A failure as a breakdown, with what the page did until then; `null` where the failure is not a breakdown. */
export function breakdownOf(job: Job, sentence: string, failure: Failure | undefined): Breakdown | null {
  if (failure === undefined || !UNFORESEEN.has(failure.code)) {
    return null;
  }
  const progress = job.kind === 'running' ? job.progress : null;
  return { sentence, failure, during: progress === null ? '' : `${progress.sentence}, ${Math.round(100 * progress.share)} %` };
}

/** The last breakdown, and the sentence on the page. */
interface Told {
  readonly breakdown: Breakdown | null;
  readonly error: string | null;
}

/** The breakdown that the sentence on the page is about; `null` where it is about none. */
export function toldBreakdown({ breakdown, error }: Told): Breakdown | null {
  return breakdown !== null && breakdown.sentence === error ? breakdown : null;
}

/** The report: it has sizes and options, but no names, no positions and nothing of the files. */
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
