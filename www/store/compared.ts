/** The map on the page beside another one of the same meshes and landmarks. */
import type { OtherMap } from '../report.ts';
import { shownResult } from './staleness.ts';
import type { ComparedMap, Comparison, State, Style } from './state.ts';
import { isKnown, isMapHeat, isTexture } from './surfaces.ts';

/** Begins a comparison, where there is a map; nothing runs beside it. */
export function withComparison(state: State, which: OtherMap): State {
  const of = shownResult(state);
  return of === null || state.job.kind === 'running'
    ? state
    : { ...state, comparison: { of, which, progress: { kind: 'computing', share: 0 } } };
}

/** The other map goes on, is there, or failed; what comes for another comparison is left out. */
export function withCompared(state: State, which: OtherMap, progress: Comparison['progress']): State {
  const { comparison } = state;
  return comparison !== null && comparison.which === which && comparison.progress.kind === 'computing' ? { ...state, comparison: { ...comparison, progress } } : state;
}

/** The state without a comparison that is not about the map on the page any more, or not looked at. */
export function withLookedAt(state: State): State {
  const { comparison, ui, job } = state;
  const isSeen = comparison !== null && comparison.of === shownResult(state) && ui.step === 'method' && job.kind !== 'running';
  return comparison === null || isSeen ? state : { ...state, comparison: null };
}

/** The other map, where it is there to be shown. */
export function otherMap({ comparison }: Pick<State, 'comparison'>): ComparedMap | null {
  return comparison?.progress.kind === 'there' ? comparison.progress.map : null;
}

/** Whether the other map can show a surface: what every map carries, and values by its own place. */
function isCarried(other: ComparedMap, surface: Style['surface']): boolean {
  return surface === 'pattern' || surface === 'colours' || isTexture(surface) || (isMapHeat(surface) && isKnown(other, surface));
}

/** How the views look: two maps are compared by what both carry, each in the shape of the source. */
export function shownStyle(state: Pick<State, 'comparison' | 'ui'>): Style {
  const { style } = state.ui;
  const other = otherMap(state);
  if (other === null) {
    return style;
  }
  const { surface } = style;
  return { ...style, surface: isCarried(other, surface) ? surface : 'pattern', textureBoundary: false, morph: 0, wipe: null };
}
