/** Heat maps: their scales can be inverted, and their values are right for maps of known distortion. */
import { expect, test } from 'vitest';
import type { Flows, SideFlow } from '../../www/compute/watch-messages.ts';
import { scaleOf } from '../../www/heat/scales.ts';
import { heatByVertex, valuesByPoint } from '../../www/heat/values.ts';
import type { HeatMap } from '../../www/store/state.ts';
import { isFlowHeat, isMapHeat } from '../../www/store/surfaces.ts';

const ALL: readonly HeatMap[] = ['distortion', 'angles', 'areas', 'truth', 'factor', 'curvature', 'flat-curvature'];

test('from a value to its place on the scale and back', () => {
  for (const heat of ALL) {
    const scale = scaleOf(heat, 8);
    for (const place of [0, 0.2, 0.5, 0.9, 1]) {
      expect(scale.place(scale.value(place)), heat).toBeCloseTo(place, 9);
    }
    expect([...scale.ticks].every((tick) => tick.length > 0)).toBe(true);
  }
  expect(scaleOf('distortion').place(2)).toBeCloseTo(0.5);
  expect(scaleOf('distortion').place(0.3)).toBe(0);
  expect(scaleOf('areas').place(1)).toBe(0.5);
  expect(scaleOf('factor', 8).value(1)).toBeCloseTo(8);
  expect(scaleOf('curvature').place(0)).toBe(0.5);
  expect(scaleOf('curvature').place(-100)).toBeCloseTo(0);
  expect(scaleOf('truth').place(0.005)).toBeCloseTo(0.5);
});

/** A strip of squares, mapped by a function of its points. */
function strip(image: (x: number, y: number) => readonly [number, number]): Parameters<typeof valuesByPoint>[0] {
  const points = Array.from({ length: 12 }, (_, k) => [Math.floor(k / 2), k % 2] as const);
  const triangles = Array.from({ length: 5 }, (_, k) => [2 * k, 2 * k + 2, 2 * k + 1, 2 * k + 1, 2 * k + 2, 2 * k + 3]).flat();
  const side = (places: readonly (readonly [number, number])[]): Parameters<typeof valuesByPoint>[0]['sides'][0] => ({
    positions: Float32Array.from(places.flatMap(([x, y]) => [x, y, 0.5])),
    normals: new Float32Array(),
    linePoints: new Float32Array(),
    lineStarts: new Uint32Array(),
  });
  return {
    sides: [side(points), side(points.map(([x, y]) => image(x, y)))],
    triangles: Uint32Array.from(triangles),
    distortion: Float32Array.from(points, () => 1.5),
    truth: new Float32Array(),
  };
}

test('a map that stretches one way distorts angles alone, once both meshes have the same area', () => {
  const output = strip((x, y) => [2 * x, y]);
  const angles = valuesByPoint(output, 'angles');
  expect(angles).toHaveLength(12);
  angles.forEach((angle) => {
    expect(angle).toBeCloseTo((2 + 1 / 2) / 2, 5);
  });
  valuesByPoint(output, 'areas').forEach((area) => {
    expect(area).toBeCloseTo(1, 5);
  });
  expect(valuesByPoint(output, 'distortion')).toBe(output.distortion);
  expect(isMapHeat('factor')).toBe(false);
});

test('the factor of the area is a mean around each point', () => {
  // The last square grows threefold: five squares become seven.
  const areas = valuesByPoint(strip((x, y) => [x < 5 ? x : 7, y]), 'areas');
  const [small, large] = [5 / 7, 15 / 7];
  expect(areas[0]).toBeCloseTo(small, 5);
  expect(areas[11]).toBeCloseTo(large, 5);
  // The points of the last column but one lie between squares of either size.
  expect(areas[9]).toBeGreaterThan(small);
  expect(areas[9]).toBeLessThan(large);
});

test('of flows the last moment is shown, by its own scale', () => {
  const flow = (scale: number): SideFlow => ({
    moments: [0, 1].map((step) => ({ step, residual: 1 - step, cgIterations: 0, edgeFlips: 0 })),
    converged: true,
    stops: [],
    packedStops: new Uint8Array(),
    radii: new Float32Array(3),
    logFactors: Float32Array.from([0, 0, 0, -scale, 0, scale]),
    curvatures: [Float32Array.from([1, 1, 1]), Float32Array.from([100, 0, -100])],
  });
  const flows: Flows = [flow(Math.log(2)), flow(Math.log(4))];
  const factor = heatByVertex(flows, 'factor');
  const rounded = (places: Float32Array | undefined): number[] => [...(places ?? [])].map((place) => Math.abs(Math.round(1000 * place) / 1000));
  expect(factor.places.map(rounded)).toEqual([
    [0.25, 0.5, 0.75],
    [0, 0.5, 1],
  ]);
  expect(factor.scale.value(1)).toBeCloseTo(4);
  const flat = heatByVertex(flows, 'flat-curvature');
  expect(rounded(flat.places[0])).toEqual([1, 0.5, 0]);
  const [before] = heatByVertex(flows, 'curvature').places;
  expect(flat.scale.value(before[0] ?? 0)).toBeCloseTo(1, 3);
  expect(isFlowHeat('areas')).toBe(false);
});
