/** What the surfaces can show now. */
import { shownResult } from './staleness.ts';
import type { Result, State, Style } from './state.ts';

/** Surfaces whose values only a map that is one-to-one has. */
const OF_PIECES: readonly Style['surface'][] = ['distortion', 'angles', 'areas'];

/** Whether a map can show a surface. */
export function isKnown({ output }: Pick<Result, 'output'>, surface: Style['surface']): boolean {
  return surface === 'truth' ? output.truth.length > 0 : !OF_PIECES.includes(surface) || output.distortion.length > 0;
}

/** Whether a surface can be shown now. */
export function isThere(state: State, surface: Style['surface']): boolean {
  if (surface === 'look') {
    return state.meshes.some((mesh) => mesh?.look === 'colours');
  }
  const result = shownResult(state);
  return surface === 'shaded' || (result !== null && isKnown(result, surface));
}
