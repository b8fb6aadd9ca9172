/** The options of a run in words, and the usual ones. A list with an option too few or too many for the core does not compile. */
import type { RunOptions, Scheme } from './report.ts';

type Texts<K extends Exclude<keyof RunOptions, 'ownCones'>> = Readonly<Record<RunOptions[K], string>>;

export const METHODS: Texts<'method'> = {
  relaxed: 'Relaxed, certified',
  thesis: 'Patch by patch',
  tutte: 'Patchwise Tutte',
};

export const BASES: Texts<'base'> = {
  joint: 'From both meshes',
  qem: 'From the target (QEM)',
};

export const CONES: Texts<'cones'> = {
  'base-domain': 'Of the base domain',
  uniform: 'All equal',
};

export const CLASSES: Texts<'class'> = {
  best: 'The best',
  'runner-up': 'The runner-up',
};

export const BORDERS: Texts<'borders'> = {
  guess: 'As the landmarks tell',
  corresponding: 'Ends of both bodies',
  missing: 'Missing data',
};

/**
 * The options of a run where the user chooses none. The page needs them before the core is loaded; a test compares them with the core's.
 */
export const USUAL_OPTIONS: RunOptions = {
  method: 'relaxed',
  base: 'joint',
  cones: 'base-domain',
  class: 'best',
  ownCones: null,
  borders: 'guess',
};

/** The discrete conformal structure of the method's flow; compared with the core's by the same test. */
export const USUAL_SCHEME: Scheme = 'inversive';

/** The most landmarks to which the program adds cones of its own; compared with the core's by the same test. */
export const MOST_LANDMARKS_WITH_OWN_CONES = 16;

/** The same between two poses of one body; compared with the core's by the same test. */
export const MOST_POSE_LANDMARKS_WITH_OWN_CONES = 40;
