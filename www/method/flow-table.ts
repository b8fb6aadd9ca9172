/** The numbers of flows, as a table. */
import type { FlowMoment, Flows, SideFlow } from '../compute/watch-messages.ts';

const NO_MOMENT: FlowMoment = { step: 0, residual: 0, cgIterations: 0, edgeFlips: 0 };

/** A moment of a flow; its last moment where it has ended before. */
export function momentAt({ moments }: SideFlow, moment: number): FlowMoment {
  return moments[Math.min(moment, moments.length - 1)] ?? NO_MOMENT;
}

/** Powers of ten between which all curvature errors lie. */
export function residualRange(flows: Flows): readonly [number, number] {
  const positive = flows.flatMap(({ moments }) => moments.map(({ residual }) => residual)).filter((residual) => residual > 0);
  if (positive.length === 0) {
    return [0.1, 1];
  }
  const low = 10 ** Math.floor(Math.log10(Math.min(...positive)));
  return [low, Math.max(10 * low, 10 ** Math.ceil(Math.log10(Math.max(...positive))))];
}

/** A CSV table with a row for each moment of both flows; its counts are of all steps so far. */
export function flowCsv(flows: Flows): string {
  const rows = flows.flatMap(({ moments }, side) =>
    moments.map(({ step, residual, cgIterations, edgeFlips }) => [side === 0 ? 'source' : 'target', step, residual, cgIterations, edgeFlips].join(',')),
  );
  return `${['mesh,Newton step,largest curvature error (rad),CG iterations,edge flips', ...rows].join('\n')}\n`;
}
