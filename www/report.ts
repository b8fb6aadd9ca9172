/** The report of a run and the choices of one, as the core declares them. */
import type { CandidateReport, Choices, FindingReport, QuestionReport, Report as RunReport, SettledLandmark } from './wasm/core.js';

export type { CertificateReport, ConeMetricReport, CoverageReport, LayoutSearchReport, ProofReport, SettledLandmark } from './wasm/core.js';

/** The numbers of a run, and where its soft landmarks settled. */
export type Report = RunReport & { readonly settled?: readonly SettledLandmark[] };

export type { BorderCase, FindingKind, MatchReport, MeshSide, OtherMap, RepairKind, Scheme, Stage } from './wasm/core.js';

/** Landmark pairs that the program has found. */
export type Candidate = CandidateReport;

/** What settles a doubt about them. */
export type Question = QuestionReport;

/** A doubt about landmark pairs, or limbs of one mesh without a landmark. */
export type Finding = FindingReport;

/** A repair that changes the shape of a mesh, and would make one that was refused fit for a map. */
export type RepairOffer =
  /** To cut handles and close them; `longest` is the longest of their loops in units of the square root of the area. */
  | { readonly kind: 'cut-handles'; readonly handles: number; readonly longest: number }
  /** To keep the largest of its parts, which has this share of the area. */
  | { readonly kind: 'keep-largest'; readonly parts: number; readonly share: number };

/** What is chosen of a run, with nothing left out. */
export type RunOptions = Readonly<Required<Choices>>;
