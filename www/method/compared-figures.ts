/** Figures of a map, to be read beside those of another one. */
import { figure, percent } from '../numbers.ts';
import type { Report } from '../report.ts';

/** A figure of a map. */
export interface Figure {
  readonly name: string;
  /** What the figure means. */
  readonly note: string;
  readonly value: string;
}

function stepsOf({ source, target }: Report['cone_metric']): string {
  return [source, target].map((flow) => (flow === null ? '–' : String(flow.newton_steps))).join(', ');
}

/** Whether the flows to both flat metrics reached the cones that were asked for. */
function haveConverged({ cone_metric: { source, target }, warnings }: Report): boolean {
  return source !== null && target !== null && !warnings.some(({ kind }) => kind === 'no_cone_metric');
}

/** The figures, in the order in which they are read. */
export function figuresOf(report: Report): readonly Figure[] {
  const { distortion } = report;
  return [
    { name: 'Energy E', note: 'Mean symmetric Dirichlet energy; 4 is the least, of a map that keeps every angle', value: figure(distortion.energy) },
    { name: 'Log density', note: 'Mean logarithm of the distortion by area; 0 is an isometry', value: figure(distortion.mean_log) },
    {
      name: 'L2 stretch',
      note: 'The stretch of the target’s flat metric, which its checkerboard shows; 1 is an isometry',
      value: distortion.l2_stretch === null ? '–' : figure(distortion.l2_stretch),
    },
    { name: 'Mapped', note: 'Share of the source’s vertices that have an image', value: percent(1 - report.unmapped_share) },
    { name: 'Newton steps', note: 'The Newton steps of the flows that bring source and target to their flat metrics', value: stepsOf(report.cone_metric) },
    { name: 'Converged', note: 'Whether both flows reached the cones that were asked for', value: haveConverged(report) ? 'yes' : 'no' },
  ];
}
