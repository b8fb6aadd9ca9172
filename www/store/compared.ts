/** Compares the map on the page with another one of the same meshes and landmarks. */
import type { OtherMap } from '../report.ts';
import { shownResult } from './staleness.ts';
import type { ComparedMap, Comparison, State, Style } from './state.ts';
import { isKnown, isMapHeat, isTexture } from './surfaces.ts';

/** Begins a comparison where there is a map and no run goes on. */
export function withComparison(state: State, which: OtherMap): State {
  const of = shownResult(state);
  return of === null || state.job.kind === 'running'
    ? state
    : { ...state, comparison: { of, which, progress: { kind: 'computing', share: 0 } } };
}

/** The state after progress, completion or failure of the other map; reports about another comparison are ignored. */
export function withCompared(state: State, which: OtherMap, progress: Comparison['progress']): State {
  const { comparison } = state;
  return comparison !== null && comparison.which === which && comparison.progress.kind === 'computing' ? { ...state, comparison: { ...comparison, progress } } : state;
}

/** The state without a comparison that is no longer about the map on the page, or no longer looked at. */
export function withLookedAt(state: State): State {
  const { comparison, ui, job } = state;
  const isSeen = comparison !== null && comparison.of === shownResult(state) && ui.step === 'method' && job.kind !== 'running';
  return comparison === null || isSeen ? state : { ...state, comparison: null };
}

/** The other map, once it has been made; `null` otherwise. */
export function otherMap({ comparison }: Pick<State, 'comparison'>): ComparedMap | null {
  return comparison?.progress.kind === 'there' ? comparison.progress.map : null;
}

/** Whether the other map can show a surface: all that a map carries, and the heat maps whose values it has. */
function isCarried(other: ComparedMap, surface: Style['surface']): boolean {
  return surface === 'pattern' || surface === 'colours' || isTexture(surface) || (isMapHeat(surface) && isKnown(other, surface));
}

/** The style of the views. While two maps are compared it is one that both can show, with the source in its own shape. */
export function shownStyle(state: Pick<State, 'comparison' | 'ui'>): Style {
  const { style } = state.ui;
  const other = otherMap(state);
  if (other === null) {
    return style;
  }
  const { surface } = style;
  return { ...style, surface: isCarried(other, surface) ? surface : 'pattern', textureBoundary: false, morph: 0, wipe: null };
}
