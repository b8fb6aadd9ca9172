/** What each number of a map means, and its value for the map on the page. */
import { figure, integer, percent } from '../numbers.ts';
import type { Report } from '../report.ts';

export interface Quantity {
  readonly name: string;
  readonly text: string;
  /** Its value in a report; `null` where it has none. */
  readonly value: (report: Report) => string | null;
}

export const QUANTITIES: readonly Quantity[] = [
  {
    name: 'Distortion D',
    text: 'At a point, (σ₁² + σ₂² + σ₁⁻² + σ₂⁻²) / 4, with the stretches σ₁ and σ₂ of the map there, both meshes scaled to area 1. It is 1 where nothing is stretched, and counts a stretch by s like a squeeze to 1/s. A stretch of 1.5 one way alone makes 1.17, a stretch of 2 makes 1.56.',
    value: () => null,
  },
  {
    name: 'Mean, median, p95, max',
    text: 'Of D over the area of the source: the mean; the value that half of the area stays below; the one that 95 % of it stay below, which the verdict translates into a stretch; and the largest, which tells of single places and little of the map.',
    value: ({ distortion: { mean, median, p95, max } }) => `${figure(mean)}, ${figure(median)}, ${figure(p95)}, ${figure(max)}`,
  },
  {
    name: 'Energy E',
    text: 'The symmetric Dirichlet energy of the map: half from the source to the target, half back. Its least value is 4, which isometries have, and conformal maps as well: E judges how angles are kept, D angles and areas. Unlike shapes with good landmarks come to 4.2 to 5.4; two poses of one body come close to 4.',
    value: ({ distortion }) => figure(distortion.energy),
  },
  {
    name: 'Certificate',
    text: 'The proof that the map is continuous, one-to-one and onto, and takes each landmark to its partner. It is about the topology of the map, not about its beauty: a certified map may be badly stretched. Without it, nothing is called a map.',
    value: ({ certificate }) => (certificate === null ? null : `${integer(certificate.flipped_triangles)} of ${integer(certificate.triangles)} triangles flipped`),
  },
  {
    name: 'Coverage',
    text: 'Where holes were closed: how much of each mesh’s skin has skin as its partner, and not a cap. The certificate is about the surfaces with their caps; all other numbers are measured where skin lies on skin.',
    value: ({ coverage }) => (coverage === null ? null : `${percent(coverage.source)} of the source, ${percent(coverage.target)} of the target`),
  },
  {
    name: 'Curvature error',
    text: 'How far the flat metrics for the texture are from the wanted cone angles, in radians. Here 10⁻⁸ is usual; it says nothing of the map.',
    value: ({ cone_metric: { source, target } }) => (source === null || target === null ? null : `${figure(Math.max(source.max_curvature_error, target.max_curvature_error))} rad`),
  },
  {
    name: 'True images',
    text: 'Where the landmark file knows the true map, as for two poses of one mesh: the distance of the images from their true places, in units of the root of the target’s area.',
    value: ({ ground_truth: truth }) => (truth === null ? null : `mean ${figure(truth.mean)}, 95 % within ${figure(truth.p95)}`),
  },
];
