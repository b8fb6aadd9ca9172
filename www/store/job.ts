/** The job of the page: it does one thing at a time, so that no run starts while files are being read. */
import type { Progress } from '../compute/messages.ts';
import type { Work } from './work.ts';

/** The page is at rest. The kind says how the last run ended; it is `idle` before the first one and after the meshes have changed. */
export interface Rest {
  readonly kind: 'idle' | 'done' | 'error';
}

/** A task other than a run, with the sentence that the page shows meanwhile. Tasks are told apart by their objects. */
export interface Task {
  readonly sentence: string;
}

/** The page is busy: files are being read, a demo is being built, or places are being looked for. */
export interface Busy {
  readonly kind: 'busy';
  readonly task: Task;
  /** The state of rest that follows. */
  readonly then: Rest;
}

/** A run goes on. */
export interface Running {
  readonly kind: 'running';
  /** The work of which the run makes a map; the page may have changed since. */
  readonly inputs: Work;
  readonly progress: Progress | null;
  /** Whether the run can be asked to finish, and whether it was asked. */
  readonly finish: 'no' | 'possible' | 'asked';
  /** The falling energies of each relaxation, the first relaxation first. */
  readonly energies: readonly (readonly number[])[];
  /** A preview of the map that is being made: for each vertex of the source its place on the target. */
  readonly preview: Float32Array | null;
}

export type Job = Rest | Busy | Running;

/** A run of this work that has just begun. */
export function started(inputs: Work): Running {
  return { kind: 'running', inputs, progress: null, finish: 'no', energies: [], preview: null };
}

/** The job after a task begins, which replaces an earlier task; during a run no task begins. */
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

/** The job after a task is over, unless another one has replaced it. */
export function ended(job: Job, task: Task): Job {
  return job.kind === 'busy' && job.task === task ? job.then : job;
}

/** The job after other meshes have come; `isMapped` where the last map belongs to them. A run goes on until the user ends it. */
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
  // After the relaxation a run can no longer be shortened.
  const finish = stage === 'certificate' && job.finish === 'possible' ? 'no' : job.finish;
  const present = job.energies.at(-1) ?? [];
  const falls = stage === 'relaxation' && energy !== null && energy < (present.at(-1) ?? Infinity);
  return { ...job, progress, finish, energies: falls ? [...job.energies.slice(0, -1), [...present, energy]] : job.energies };
}
