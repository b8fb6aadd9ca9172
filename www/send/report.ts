/** The shape of a run's report in a map file, which may come from anywhere and is therefore checked. */
import * as v from 'valibot';
import { BORDERS } from '../options.ts';
import type { BorderCase, FindingKind, MeshSide, RepairKind, Report } from '../report.ts';
import { wordsOf } from '../unions.ts';
import { Index, Text, Weight } from './schema.ts';

/** The most characters of a report; one with ten thousand doubtful landmarks has some hundred kB. */
const LONGEST = 10_000_000;

const Figure = v.pipe(v.number(), v.finite());
const MaybeFigure = v.nullable(Figure);
const Place = v.object({ face: Index, barycentric: v.strictTuple([Weight, Weight, Weight]) });
const ConeMetric = v.object({
  newton_steps: Index,
  cg_iterations: Index,
  edge_flips: Index,
  max_curvature_error: Figure,
  residuals: v.array(Figure),
  seconds: Figure,
});
const Rim = v.object({ vertex: Index, vertices: Index, length: Figure });
const Finding = v.object({
  kind: v.picklist(wordsOf<FindingKind>({ mirrored: true, swapped: true, misplaced: true, unmarked_limbs: true })),
  pairs: v.array(Index),
  repair: v.picklist(wordsOf<RepairKind>({ mirror_target: true, swap: true, check: true, mark: true })),
  sentence: Text,
  agreement: MaybeFigure,
  misfit: v.nullable(v.strictTuple([Figure, Figure])),
  distance: MaybeFigure,
  near: v.nullable(Index),
  side: v.nullable(v.picklist([0, 1])),
  vertices: v.array(Index),
});

/** The shape of a report; fields that it does not list are dropped. */
export const ReportSchema = v.object({
  base_domain: v.object({ vertices: Index, faces: Index }),
  layout: v.nullable(
    v.object({
      judged: Index,
      rival: MaybeFigure,
      twists: Index,
      mean_log: MaybeFigure,
      runner_up: MaybeFigure,
      path_stretch: Figure,
    }),
  ),
  own_landmarks: Index,
  cone_metric: v.object({ source: v.nullable(ConeMetric), target: v.nullable(ConeMetric) }),
  // Files from before this was measured do not have it.
  coverage: v.optional(v.nullable(v.object({ source: Figure, target: Figure, hidden: Figure })), null),
  borders: v.optional(
    v.nullable(
      v.object({
        case: v.picklist(wordsOf<BorderCase>({ missing: true, corresponding: true })),
        asked: v.picklist(wordsOf(BORDERS)),
        rims: v.array(v.object({ source: Rim, target: Rim, misfit: Figure })),
      }),
    ),
    null,
  ),
  certificate: v.nullable(
    v.object({
      bijective: v.boolean(),
      triangles: Index,
      flipped_triangles: Index,
      max_angle_sum_error: Figure,
      max_landmark_error: Figure,
    }),
  ),
  distortion: v.object({
    energy: Figure,
    mean: Figure,
    mean_log: Figure,
    median: Figure,
    p95: Figure,
    max: Figure,
    dented: Figure,
    worst: v.array(v.object({ density: Figure, area: Figure, source: Place, target: Place })),
    l2_stretch: MaybeFigure,
  }),
  unmapped_share: Figure,
  ground_truth: v.nullable(v.object({ mean: Figure, p95: Figure, max: Figure })),
  stopped_early: v.boolean(),
  faces: v.object({ source: Index, target: Index }),
  findings: v.array(Finding),
  warnings: v.array(
    v.object({ kind: Text, sentence: Text, value: MaybeFigure, side: v.nullable(v.picklist(wordsOf<MeshSide>({ source: true, target: true }))) }),
  ),
  seconds: v.record(Text, Figure),
}) satisfies v.GenericSchema<unknown, Report>;

/** The report in a text; `null` where the text is not a report. */
export function reportIn(text: string): Report | null {
  if (text.length > LONGEST) {
    return null;
  }
  try {
    const parsed = v.safeParse(ReportSchema, JSON.parse(text));
    return parsed.success ? parsed.output : null;
  } catch {
    return null;
  }
}
