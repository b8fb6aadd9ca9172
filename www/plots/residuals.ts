/** The plot of how the flows to the flat metrics converged: the largest curvature error after each Newton step. */
import type { Report } from '../report.ts';
import type { Chart, Curve } from './chart.ts';
import { evenMarks, logMarks } from './chart.ts';

type Flows = Report['cone_metric'];

const SIDES = [
  { side: 'source', name: 'Source', colour: 'first' },
  { side: 'target', name: 'Target', colour: 'second' },
] as const;

function curvesOf(flows: Flows, of: Curve['of'], steps: number): readonly Curve[] {
  return SIDES.flatMap(({ side, name, colour }) => {
    const residuals = flows[side]?.residuals ?? [];
    // Zero has no logarithm, so a residual of 0 is left out.
    const values = Array.from({ length: steps }, (_, k) => (residuals[k] ?? 0) > 0 ? (residuals[k] ?? null) : null);
    return residuals.length === 0 ? [] : [{ name: of === 'now' ? name : `${name} before`, of, colour, values }];
  });
}

/** The plot; `null` where no flow has begun. */
export function residualChart(now: Flows, before: Flows | null): Chart | null {
  const all = [now, before].flatMap((flows) => SIDES.map(({ side }) => flows?.[side]?.residuals ?? []));
  const steps = Math.max(...all.map(({ length }) => length));
  const positive = all.flat().filter((residual) => residual > 0);
  if (now.source === null && now.target === null) {
    return null;
  }
  if (steps === 0 || positive.length === 0) {
    return null;
  }
  const whole = (value: number, round: (value: number) => number): number => 10 ** round(Math.log10(value));
  const low = whole(Math.min(...positive), Math.floor);
  const range = [low, Math.max(10 * low, whole(Math.max(...positive), Math.ceil))] as const;
  const last = Math.max(1, steps - 1);
  return {
    id: 'residuals',
    title: 'Convergence of the flat metrics',
    x: { title: 'Newton step', scale: 'linear', range: [0, last], marks: evenMarks([0, last], 8).filter((mark) => Number.isInteger(mark)) },
    y: { title: 'Largest curvature error (rad)', scale: 'log', range, marks: logMarks(range, 8) },
    at: Array.from({ length: last + 1 }, (_, k) => k),
    curves: [...curvesOf(now, 'now', last + 1), ...(before === null ? [] : curvesOf(before, 'before', last + 1))],
    shape: 'line',
  };
}
