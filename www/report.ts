/** The report of a run and the choices of one, as the core declares them. */
import type { Choices, FindingReport } from './wasm/conemap.js';

export type { CertificateReport, ConeMetricReport, CoverageReport, LayoutSearchReport, Report } from './wasm/conemap.js';

/** A doubt about landmark pairs, or limbs of one mesh without a landmark. */
export type Finding = FindingReport;

/** What is chosen of a run, with nothing left out. */
export type RunOptions = Readonly<Required<Choices>>;
