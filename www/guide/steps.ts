/** The ten steps of the method: what each does, its equation, its drawing, and what the last run reports about it. */
import type { FunctionComponent } from 'preact';
import { figure, integer } from '../numbers.ts';
import type { ConeMetricReport, Report } from '../report.ts';
import type { Style } from '../store/state.ts';
import { BaseDomain, Collapse, Flip, Overlay, Star } from './drawings/meshes.tsx';
import { Circles, Cone, Distorted, Twist, Winding } from './drawings/surfaces.tsx';
import type { Formula } from './equation.tsx';

export interface MethodStep {
  readonly name: string;
  readonly text: readonly string[];
  readonly formula: Formula;
  readonly Picture: FunctionComponent;
  /** What a report says about the step; `null` where it says nothing. */
  readonly fact: (report: Report) => string | null;
  /** The style in which the views show the step on the meshes; `null` where they cannot. */
  readonly look: Partial<Style> | null;
}

function sumOf(flows: Report['cone_metric'], count: (flow: ConeMetricReport) => number): number {
  return [flows.source, flows.target].reduce((sum, flow) => sum + (flow === null ? 0 : count(flow)), 0);
}

function layoutFact({ layout }: Report): string | null {
  if (layout === null) {
    return null;
  }
  const path = `The longest path is ${layout.path_stretch.toFixed(2)} times as long as the shortest between its landmarks.`;
  return layout.judged > 1 ? `The best of ${integer(layout.judged)} ways to go round the limbs. ${path}` : path;
}

export const METHOD: readonly MethodStep[] = [
  {
    name: 'Coarsen both meshes',
    text: [
      'Vertices collapse into a neighbour until about 500 are left, the landmarks always among them. Which goes next, and into which neighbour, is told by the quadric error: the sum of the squared distances to the planes of the faces around, each times its area.',
      'On coarse meshes a whole map costs a fraction of a second, so that many can be tried.',
    ],
    formula: { tex: String.raw`Q(x)=\sum_{f} A_f\,(n_f\cdot x+d_f)^2`, plain: 'Q(x) = Σ A (n·x + d)², over faces of area A' },
    Picture: Collapse,
    fact: ({ faces }) => `The full meshes have ${integer(faces.source)} and ${integer(faces.target)} triangles.`,
    look: null,
  },
  {
    name: 'Join the landmarks by a base domain',
    text: [
      'A triangulation with the landmarks as its vertices is drawn on both meshes at once. Its edges become corresponding paths that do not cross. How many there are follows from Euler’s formula for the sphere.',
    ],
    formula: { tex: String.raw`V-E+F=2,\quad E=3n-6,\quad F=2n-4`, plain: 'V − E + F = 2, E = 3n − 6, F = 2n − 4' },
    Picture: BaseDomain,
    fact: ({ base_domain: base }) => `Here it has ${integer(base.vertices)} corners and ${integer(base.faces)} triangles.`,
    look: { patchLines: true },
  },
  {
    name: 'Choose the class of the map',
    text: [
      'A path may pass a leg on its left or on its right, or wind around it. No smoothing repairs that later, so the drawings of different isotopy classes, and their Dehn twists, are each made a coarse map. The class of least mean logarithm of the distortion D stays. (The energy E would not tell them apart as well: it is 4 for every conformal map.)',
    ],
    formula: {
      tex: String.raw`\frac{1}{2}\int_S\log D\,dA_S+\frac{1}{2}\int_T\log D\,dA_T`,
      plain: '½ (∫ log D dA over the source + ∫ log D dA over the target)',
    },
    Picture: Twist,
    fact: layoutFact,
    look: { patchLines: true },
  },
  {
    name: 'Make one flat surface with cones',
    text: [
      'The triangles of the base domain are made flat. Each edge is as long as the mean of the distances of its landmarks in space, on both meshes. Glued together they are one surface that is flat but at the landmarks, where it has cones: this is the place where both meshes meet.',
      'The curvature of a cone is what its triangles lack of a full turn. A saddle-like cone has more than a full turn, and negative curvature. All curvatures together are 4π, whatever the shape.',
    ],
    formula: {
      tex: String.raw`K_i=2\pi-\sum_{f\ni i}\theta^f_i,\qquad\sum_i K_i=4\pi`,
      plain: 'K = 2π − Σ θ around each landmark; Σ K = 4π',
    },
    Picture: Cone,
    fact: ({ own_landmarks: own }) =>
      own === 0 ? null : `The program added ${integer(own)} cones of its own: at ends of limbs without a landmark, or because the landmarks are few.`,
    look: { cones: true },
  },
  {
    name: 'Lay each mesh onto it without a flip',
    text: [
      'A coarse mesh is taken apart to its base domain and comes back vertex by vertex. Each vertex is put into the kernel of its star, where it sees every edge around it from the left. So no triangle is ever turned over, and none has to be repaired.',
    ],
    formula: { tex: String.raw`\det\,(b-a,\;x-a)>0\quad\text{for every edge }ab`, plain: 'det (b − a, x − a) > 0 for every edge ab of the star' },
    Picture: Star,
    fact: () => null,
    look: null,
  },
  {
    name: 'Relax on the flat surface',
    text: [
      'On each triangle the map onto the flat surface is linear, with the matrix J and its singular values σ₁ and σ₂. The symmetric Dirichlet energy of these matrices is lowered by Newton’s method with the exact Hessian, made positive, per triangle. Vertices cross the edges of the base domain; a step ends before the first triangle would turn over, where the energy is infinite.',
    ],
    formula: {
      tex: String.raw`\|J\|^2+\|J^{-1}\|^2=\sigma_1^2+\sigma_2^2+\sigma_1^{-2}+\sigma_2^{-2}`,
      plain: '‖J‖² + ‖J⁻¹‖² = σ₁² + σ₂² + σ₁⁻² + σ₂⁻²',
    },
    Picture: Distorted,
    fact: () => null,
    look: null,
  },
  {
    name: 'Relax the map itself',
    text: [
      'The map from source to target goes through the flat surface: there and back. Two halves of least distortion do not make the map of least distortion. So both meshes are laid over each other; on each common piece the map is affine, and its energy counts both directions alike. One mesh moves over the other in turn, by damped Newton steps whose gradient knows that the pieces change.',
      'Then the vertices of the full meshes come back level by level, and on each level the energy is lowered again.',
    ],
    formula: {
      tex: String.raw`E=\int_S\|J\|^2\,dA_S+\int_T\|J^{-1}\|^2\,dA_T\;\ge\;4`,
      plain: 'E = ∫ ‖J‖² dA over the source + ∫ ‖J⁻¹‖² dA over the target ≥ 4',
    },
    Picture: Overlay,
    fact: ({ distortion }) => `Here E = ${figure(distortion.energy)}.`,
    look: { surface: 'distortion' },
  },
  {
    name: 'Prove it',
    text: [
      'A check that shares nothing with all that went before looks at every triangle of both meshes on the flat surface: each is positive, by exact predicates; the angles around each vertex sum to a full turn, around each landmark to the angle of its cone. Positive triangles alone would not do: they may wind twice. And each edge of the base domain, followed straight over the mesh, arrives at its landmark without crossing another.',
      'Then both halves are one-to-one and onto, and so is the map.',
    ],
    formula: {
      tex: String.raw`\det>0,\quad\sum\theta=2\pi,\quad\sum\theta_i=2\pi-K_i`,
      plain: 'det > 0, Σ θ = 2π, and 2π − K at each landmark',
    },
    Picture: Winding,
    fact: ({ certificate }) =>
      certificate === null
        ? 'The method that was chosen has no certificate.'
        : `${integer(certificate.flipped_triangles)} of ${integer(certificate.triangles)} triangles are flipped; angle sums are right within ${figure(certificate.max_angle_sum_error)} rad.`,
    look: null,
  },
  {
    name: 'For the texture: a flat metric of each mesh',
    text: [
      'The checkerboard comes from another flat surface: each mesh is deformed conformally until its only curvature sits at the landmarks. Each vertex has a circle, each edge the inversive distance of its two circles, which stays while the radii change. Newton’s method on a convex energy finds the radii γ = exp u for the wanted curvatures K*; its Hessian H is a graph Laplacian, solved by conjugate gradients.',
      'This is for texture coordinates alone. That two such surfaces have equal cones does not make them equal.',
    ],
    formula: {
      tex: String.raw`\ell_{ij}^2=\gamma_i^2+\gamma_j^2+2\eta_{ij}\gamma_i\gamma_j,\quad H\,\delta u=K^{*}-K`,
      plain: 'ℓ² = γᵢ² + γⱼ² + 2 η γᵢ γⱼ; H δu = K* − K, with γ = exp u',
    },
    Picture: Circles,
    fact: ({ cone_metric: flows }: Report): string | null => {
      const steps = sumOf(flows, ({ newton_steps: count }) => count);
      return steps === 0 ? null : `Here both took ${integer(steps)} Newton steps and ${integer(sumOf(flows, ({ cg_iterations: count }) => count))} iterations.`;
    },
    look: { surface: 'checkerboard' },
  },
  {
    name: 'Flip edges, so that it cannot break',
    text: [
      'While lengths change, triangles may degenerate. The triangulation is kept weighted Delaunay by flips of edges in the fixed hyperbolic structure that the circles define, and so the energy stays convex and the flow arrives. For circles of radius zero the rule is the familiar one: the angles opposite an edge sum to at most π. On a fixed triangulation the flow breaks down on limbs.',
    ],
    formula: { tex: String.raw`\alpha+\beta\le\pi`, plain: 'α + β ≤ π' },
    Picture: Flip,
    fact: ({ cone_metric: flows }: Report): string | null => {
      const flips = sumOf(flows, ({ edge_flips: count }) => count);
      return flips === 0 ? null : `Here ${integer(flips)} edges were flipped.`;
    },
    look: null,
  },
];
