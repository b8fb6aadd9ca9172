/** What the page does: one thing at a time, so that no run starts while files are being read. */
import type { Progress } from '../compute/messages.ts';
import type { Work } from './work.ts';

/** How the last run ended; `idle` before the first one and after the meshes changed. */
export interface Rest {
  readonly kind: 'idle' | 'done' | 'error';
}

/** Work other than a run, with what the page says meanwhile. Two works are told apart by their objects. */
export interface Task {
  readonly sentence: string;
}

/** Files are being read, a demo is being built, or places are being looked for. */
export interface Busy {
  readonly kind: 'busy';
  readonly task: Task;
  /** What follows. */
  readonly then: Rest;
}

/** A run under way. */
export interface Running {
  readonly kind: 'running';
  /** What it makes a map of; the page may have changed since. */
  readonly inputs: Work;
  readonly progress: Progress | null;
  /** Whether it can be asked to finish, and whether it was. */
  readonly finish: 'no' | 'possible' | 'asked';
  /** Falling energies of each relaxation, the first first. */
  readonly energies: readonly (readonly number[])[];
  /** The map as it is being made: by vertex of the source its place on the target. */
  readonly preview: Float32Array | null;
}

export type Job = Rest | Busy | Running;

/** A run of this work that has just begun. */
export function started(inputs: Work): Running {
  return { kind: 'running', inputs, progress: null, finish: 'no', energies: [], preview: null };
}

/** A task begins, in place of another one; during a run none does. */
export function begun(job: Job, task: Task): Job {
  switch (job.kind) {
    case 'running':
      return job;
    case 'busy':
      return { ...job, task };
    case 'idle':
    case 'done':
    case 'error':
      return { kind: 'busy', task, then: job };
  }
}

/** A task is over, unless another one has taken its place. */
export function ended(job: Job, task: Task): Job {
  return job.kind === 'busy' && job.task === task ? job.then : job;
}

/** Other meshes have come; `isMapped` where the last map is theirs. A run goes on until somebody ends it. */
export function settled(job: Job, isMapped: boolean): Job {
  const rest: Rest = { kind: isMapped ? 'done' : 'idle' };
  switch (job.kind) {
    case 'running':
      return job;
    case 'busy':
      return { ...job, then: rest };
    case 'idle':
    case 'done':
    case 'error':
      return rest;
  }
}

/** A run after a report of its progress. */
export function advanced(job: Running, progress: Progress): Running {
  const { energy, stage } = progress;
  // After the relaxation there is nothing left to shorten.
  const finish = stage === 'certificate' && job.finish === 'possible' ? 'no' : job.finish;
  const present = job.energies.at(-1) ?? [];
  const falls = stage === 'relaxation' && energy !== null && energy < (present.at(-1) ?? Infinity);
  return { ...job, progress, finish, energies: falls ? [...job.energies.slice(0, -1), [...present, energy]] : job.energies };
}

/** The map in the making that a state shows; `null` where no run of the meshes on the page has one. */
export function shownPreview({ job, meshes }: { readonly job: Job; readonly meshes: Work['meshes'] }): Float32Array | null {
  return job.kind === 'running' && job.inputs.meshes[0] === meshes[0] && job.inputs.meshes[1] === meshes[1] ? job.preview : null;
}
