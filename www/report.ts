/** The report of a run, as the core writes it. */
export interface Report {
  readonly base_domain: { readonly vertices: number; readonly faces: number };
  readonly cone_metric: { readonly source: FlowReport; readonly target: FlowReport };
  readonly layout: LayoutSearch | null;
  /** Points that the program added as cones of its own and held. */
  readonly own_landmarks: number;
  readonly certificate: Certificate | null;
  readonly distortion: {
    readonly energy: number;
    readonly mean: number;
    readonly mean_log: number;
    readonly median: number;
    readonly p95: number;
    readonly max: number;
    readonly dented: number;
    readonly worst: readonly WorstPiece[];
    readonly l2_stretch: number;
  };
  /** Whether the result was asked for before it was done. */
  readonly stopped_early: boolean;
  readonly unmapped_share: number;
  readonly ground_truth: { readonly mean: number; readonly p95: number; readonly max: number } | null;
  readonly faces: { readonly source: number; readonly target: number };
  readonly findings: readonly Finding[];
  readonly warnings: readonly string[];
  readonly seconds: Readonly<Record<string, number>>;
}

/** A piece of the overlay of large density, with its middle on both meshes. */
export interface WorstPiece {
  readonly density: number;
  readonly area: number;
  readonly source: Place;
  readonly target: Place;
}

/** A point of a mesh. */
export interface Place {
  readonly face: number;
  readonly barycentric: readonly [number, number, number];
}

/** One flow to a cone metric. */
export interface FlowReport {
  readonly newton_steps: number;
  readonly cg_iterations: number;
  readonly edge_flips: number;
  readonly max_curvature_error: number;
}

/** The independent check of bijectivity. */
export interface Certificate {
  readonly bijective: boolean;
  readonly triangles: number;
  readonly flipped_triangles: number;
  readonly max_angle_sum_error: number;
  readonly max_landmark_error: number;
}

/** The search for the class of the map. */
export interface LayoutSearch {
  readonly judged: number;
  readonly twists: number;
  readonly mean_log: number | null;
  readonly runner_up: number | null;
  /** The best other class relative to the one chosen; null where none is close. */
  readonly rival: number | null;
  readonly path_stretch: number;
}

/** A doubt about landmark pairs, numbered from 0, or limbs of one mesh without a landmark. */
export interface Finding {
  readonly kind: 'mirrored' | 'swapped' | 'misplaced' | 'unmarked_limbs';
  readonly pairs: readonly number[];
  readonly repair: 'mirror_target' | 'swap' | 'check' | 'mark';
  readonly sentence: string;
  /** Of limbs: 0 the source, 1 the target. */
  readonly side: 0 | 1 | null;
  /** Of limbs: their ends. */
  readonly vertices: readonly number[];
}
