/** What heat maps show: values by point of the map, or by vertex of both meshes. */
import type { Flows } from '../compute/watch-messages.ts';
import { scaleEnd } from '../method/factors.ts';
import { measurePieces } from '../plots/spectrum.ts';
import type { HeatMap, Result } from '../store/state.ts';
import { needsFlows } from '../store/flat.ts';
import type { Scale } from './scales.ts';
import { scaleOf } from './scales.ts';

type Output = Pick<Result['output'], 'sides' | 'triangles' | 'distortion' | 'truth'>;

/** By point of a map's overlay; what was measured once is kept as long as the map. */
const MEASURED = new WeakMap<object, Map<'angles' | 'areas', Float32Array>>();

/** The mean logarithm of a measure over the pieces around each point, by area. */
function aroundPoints({ sides, triangles }: Output, heat: 'angles' | 'areas'): Float32Array {
  const count = sides[0].positions.length / 3;
  const [sums, weights] = [new Float64Array(count), new Float64Array(count)];
  const pieces = { triangles, places: [sides[0].positions, sides[1].positions], areWhole: true } as const;
  measurePieces(pieces, (first, { share, measures }) => {
    const value = Math.log(heat === 'angles' ? measures.angle : measures.area);
    for (let corner = first; corner < first + 3; corner++) {
      const point = triangles[corner] ?? 0;
      sums[point] = (sums[point] ?? 0) + share * value;
      weights[point] = (weights[point] ?? 0) + share;
    }
  });
  return Float32Array.from(sums, (sum, point) => Math.exp(sum / Math.max(weights[point] ?? 0, Number.MIN_VALUE)));
}

/** The values of a heat map by point of the map; `null` where it is one of the meshes' vertices. */
export function valuesByPoint(output: Output, heat: HeatMap): Float32Array | null {
  if (heat === 'distortion' || heat === 'truth') {
    return output[heat];
  }
  if (heat !== 'angles' && heat !== 'areas') {
    return null;
  }
  const known = MEASURED.get(output.triangles) ?? new Map<'angles' | 'areas', Float32Array>();
  MEASURED.set(output.triangles, known);
  const values = known.get(heat) ?? aroundPoints(output, heat);
  known.set(heat, values);
  return values;
}

/** A heat map of both meshes' vertices: its scale, and the places of the vertices on it. */
export interface VertexHeat {
  readonly scale: Scale;
  readonly places: readonly [Float32Array, Float32Array];
}

/** What flows tell of the vertices; `null` where the heat map is none of the vertices. */
export function heatByVertex(flows: Flows, heat: HeatMap): VertexHeat | null {
  if (!needsFlows(heat)) {
    return null;
  }
  const scale = scaleOf(heat, scaleEnd(flows));
  const places = (side: 0 | 1): Float32Array => {
    const { logFactors, moments, curvatures } = flows[side];
    if (heat === 'factor') {
      const last = logFactors.subarray(logFactors.length - logFactors.length / Math.max(1, moments.length));
      return last.map((logFactor) => scale.place(Math.exp(logFactor)));
    }
    return curvatures[heat === 'curvature' ? 0 : 1].map(scale.place);
  };
  return { scale, places: [places(0), places(1)] };
}
