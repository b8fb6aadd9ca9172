/** The kinds of surfaces, and which of them can be shown now. */
import { shownResult } from './staleness.ts';
import type { FlowHeat, HeatMap, MapHeat, Result, State, Style } from './state.ts';
import { FLOW_HEATS, MAP_HEATS, TEXTURES } from './state.ts';

type Surface = Style['surface'];

/** Whether a surface lies on the flat metric. */
export function isTexture(surface: Surface): boolean {
  return TEXTURES.some((one) => one === surface);
}

/** Whether a surface is a heat map of values at places of the map. */
export function isMapHeat(surface: Surface): surface is MapHeat {
  return MAP_HEATS.some((one) => one === surface);
}

/** Whether a surface is a heat map of values of the flows. */
export function isFlowHeat(surface: Surface): surface is FlowHeat {
  return FLOW_HEATS.some((one) => one === surface);
}

export function isHeatMap(surface: Surface): surface is HeatMap {
  return isMapHeat(surface) || isFlowHeat(surface);
}

/** Whether a map can show a surface; only a map that is one-to-one has distortions. */
export function isKnown({ output }: { readonly output: Pick<Result['output'], 'distortion' | 'truth'> }, surface: Surface): boolean {
  return !isMapHeat(surface) || output[surface === 'truth' ? 'truth' : 'distortion'].length > 0;
}

/** Whether a surface can be shown now. */
export function isThere(state: State, surface: Surface): boolean {
  if (surface === 'look') {
    return state.meshes.some((mesh) => mesh?.look === 'colours');
  }
  const result = shownResult(state);
  return surface === 'shaded' || (result !== null && isKnown(result, surface));
}
