/** The report of a run, as the core writes it. */
export interface Report {
  readonly base_domain: { readonly vertices: number; readonly faces: number };
  readonly cone_metric: { readonly source: FlowReport; readonly target: FlowReport };
  readonly certificate: Certificate | null;
  readonly distortion: {
    readonly energy: number;
    readonly mean: number;
    readonly median: number;
    readonly p95: number;
    readonly max: number;
    readonly l2_stretch: number;
  };
  readonly unmapped_share: number;
  readonly ground_truth: { readonly mean: number; readonly p95: number; readonly max: number } | null;
  readonly faces: { readonly source: number; readonly target: number };
  readonly warnings?: readonly string[];
  readonly seconds: Readonly<Record<string, number>>;
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
  readonly flipped_triangles: number;
  readonly max_angle_sum_error: number;
  readonly max_landmark_error: number;
}
