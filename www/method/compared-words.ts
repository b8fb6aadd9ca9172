/** The names of the other maps with which the map on the page is compared. */
import type { OtherMap } from '../report.ts';

/** The name of each map in a list of choices, and in a sentence about a view. */
export const OTHER_NAMES: Readonly<Record<OtherMap, { readonly choice: string; readonly caption: string }>> = {
  start: { choice: 'Before relaxation', caption: 'before relaxation' },
  'equal-cones': { choice: 'Equal cones', caption: 'equal cones' },
  patchwise: { choice: 'Patchwise', caption: 'patch by patch' },
  tutte: { choice: 'Patchwise Tutte', caption: 'patchwise Tutte' },
};
