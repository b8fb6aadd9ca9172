/** The values of heat maps: at points of the map's overlay, or at vertices of both meshes. */
import type { Flows } from '../compute/watch-messages.ts';
import { momentCount, placesAt, scaleEnd } from '../method/factors.ts';
import { measurePieces } from '../plots/spectrum.ts';
import type { FlowHeat, MapHeat, Result } from '../store/state.ts';
import type { Scale } from './scales.ts';
import { scaleOf } from './scales.ts';

type Output = Pick<Result['output'], 'sides' | 'triangles' | 'distortion' | 'truth'>;

/** Values at the points of each map's overlay; they are kept as long as the map. */
const MEASURED = new WeakMap<object, Map<'angles' | 'areas', Float32Array>>();

/** The mean logarithm of a measure over the pieces around each point, weighted by area. */
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

/** The values of a heat map at the points of the map's overlay. */
export function valuesByPoint(output: Output, heat: MapHeat): Float32Array {
  if (heat === 'distortion' || heat === 'truth') {
    return output[heat];
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

/** The heat map that flows give at the vertices. */
export function heatByVertex(flows: Flows, heat: FlowHeat): VertexHeat {
  const end = scaleEnd(flows);
  const scale = scaleOf(heat, end);
  if (heat === 'factor') {
    const [source, target] = placesAt(flows, momentCount(flows) - 1, end);
    return { scale, places: [source.from, target.from] };
  }
  const places = (side: 0 | 1): Float32Array => flows[side].curvatures[heat === 'curvature' ? 0 : 1].map(scale.place);
  return { scale, places: [places(0), places(1)] };
}
