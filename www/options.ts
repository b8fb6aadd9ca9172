/** What can be chosen of a run, in words, and what is usual. A choice that the core does not have, or has beside these, does not compile. */
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

/** What is chosen where nobody chooses; a test holds it against the core's, which comes after the page. */
export const USUAL_OPTIONS: RunOptions = {
  method: 'relaxed',
  base: 'joint',
  cones: 'base-domain',
  class: 'best',
  ownCones: null,
  borders: 'guess',
};

/** The structure of the flow that the method goes by, likewise. */
export const USUAL_SCHEME: Scheme = 'inversive';

/** The most landmarks to which the program adds cones of its own, likewise. */
export const MOST_LANDMARKS_WITH_OWN_CONES = 16;
