/** Conformal factors as places on a scale of colours. */
import type { Flows, SideFlow } from '../compute/watch-messages.ts';
import type { FactorPlaces, FlowFrame } from './hands.ts';

/** The share of the vertices that lie within the scale; the few beyond it, at sharp cones, have its last colour. */
const WITHIN = 0.98;

/** The number of vertices in a flow. */
function vertexCount({ moments, logFactors }: SideFlow): number {
  return moments.length === 0 ? 0 : logFactors.length / moments.length;
}

function momentOf(flow: SideFlow, moment: number): Float32Array {
  const count = vertexCount(flow);
  const at = Math.min(Math.max(0, moment), flow.moments.length - 1);
  return flow.logFactors.subarray(at * count, (at + 1) * count);
}

/** The number of moments in the longer flow. */
export function momentCount(flows: Flows): number {
  return Math.max(...flows.map(({ moments }) => moments.length));
}

/**
 * The end of the scale, which goes from the inverse of its end through 1 to its end: a power of 2, so that nearly all vertices of both
 * meshes lie within the scale at the end of the flows.
 */
export function scaleEnd(flows: Flows): number {
  const sizes = flows.map((flow) => {
    const sorted = momentOf(flow, flow.moments.length - 1).map(Math.abs).sort();
    return sorted[Math.min(sorted.length - 1, Math.floor(WITHIN * sorted.length))] ?? 0;
  });
  return 2 ** Math.max(1, Math.ceil(Math.max(...sizes) / Math.LN2 - 1e-6));
}

/** A CSS gradient of the renderer's colours, which are linear red, green and blue one after the other. */
export function gradientOf(colours: Float32Array): string {
  const stops = Array.from({ length: colours.length / 3 }, (_, k) => `color(srgb-linear ${colours.slice(3 * k, 3 * k + 3).join(' ')})`);
  return `linear-gradient(90deg, ${stops.join(', ')})`;
}

/** The place of a factor's logarithm on the scale: 0 at the inverse of the scale's end, 1/2 at 1, 1 at its end. */
export function placeOf(logFactor: number, end: number): number {
  return 0.5 + logFactor / (2 * Math.log(end));
}

function placesOf(flow: SideFlow, moment: number, end: number): FactorPlaces {
  const places = (at: number): Float32Array => momentOf(flow, at).map((logFactor) => placeOf(logFactor, end));
  return { from: places(moment), to: places(moment + 1) };
}

/** The radii of both meshes' circles at a moment, in units of the root of each mesh's area; `null` where the flows have no circles. */
export function radiiAt(flows: Flows, moment: number): readonly [Float32Array, Float32Array] | null {
  const radii = (flow: SideFlow): Float32Array => momentOf(flow, moment).map((logFactor, v) => (flow.radii[v] ?? 0) * Math.exp(logFactor));
  return flows.some((flow) => flow.radii.length === 0) ? null : [radii(flows[0]), radii(flows[1])];
}

/** The places of both meshes' vertices on the scale at a moment and the next one; a flow that has ended stays at its last moment. */
export function placesAt(flows: Flows, moment: number, end: number): FlowFrame['places'] {
  return [placesOf(flows[0], moment, end), placesOf(flows[1], moment, end)];
}
