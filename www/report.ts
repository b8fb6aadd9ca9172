/** The report of a run and the choices for one, as the core declares them. */
import type { CandidateReport, Choices, FindingReport, QuestionReport, Report as RunReport, SettledLandmark } from './wasm/core.js';

export type { CertificateReport, ConeMetricReport, CoverageReport, LayoutSearchReport, ProofReport, SettledLandmark } from './wasm/core.js';

/** The numbers of a run, and where its soft landmarks settled. */
export type Report = RunReport & { readonly settled?: readonly SettledLandmark[] };

export type { BorderCase, FindingKind, MatchReport, MeshSide, OtherMap, RepairKind, Scheme, Stage } from './wasm/core.js';

/** A set of landmark pairs that the program has found. */
export type Candidate = CandidateReport;

/** The question that settles a doubt about them. */
export type Question = QuestionReport;

/** A doubt about landmark pairs, or limbs of one mesh without a landmark. */
export type Finding = FindingReport;

/** A repair that changes the shape of a mesh, and makes a refused one fit for a map. */
export type RepairOffer =
  /** Cutting handles and closing the cuts; `longest` is the longest of the cut loops, in units of the square root of the area. */
  | { readonly kind: 'cut-handles'; readonly handles: number; readonly longest: number }
  /** Keeping the largest of the parts, which has this share of the area. */
  | { readonly kind: 'keep-largest'; readonly parts: number; readonly share: number };

/** All options of a run. */
export type RunOptions = Readonly<Required<Choices>>;
