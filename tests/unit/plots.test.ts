/** Plots: what they show of a report and of a map's pieces, and their files. */
import { beforeAll, describe, expect, test } from 'vitest';
import type { Chart } from '../../www/plots/chart.ts';
import { evenMarks, indexAt, logMarks, markText, reading, shareOf } from '../../www/plots/chart.ts';
import { beyond, distortionChart } from '../../www/plots/distortion.ts';
import { chartCsv, chartSvg } from '../../www/plots/files.ts';
import { residualChart } from '../../www/plots/residuals.ts';
import type { Spectra } from '../../www/plots/spectrum.ts';
import { measure, quantile, spectraOf } from '../../www/plots/spectrum.ts';
import type { ConeMetricReport, Report } from '../../www/report.ts';
import type { Pieces } from '../../www/store/state.ts';
import { buildDemo, runMap } from '../../www/wasm/core.js';
import { after, DONE, OUTPUT, REPORT } from './fixtures.ts';
import { startCoreModule } from './modules.ts';

const pause = (): Promise<void> => Promise.resolve();

describe('marks', () => {
  test('of an even axis are round numbers within it', () => {
    expect(evenMarks([0, 7], 8)).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
    expect(evenMarks([0, 100], 5)).toEqual([0, 20, 40, 60, 80, 100]);
    expect(evenMarks([0, 0.3], 5)).toEqual([0, 0.1, 0.2, 0.3]);
    expect(evenMarks([3, 3], 5)).toEqual([3]);
  });

  test('of a logarithmic axis lie within it and are never more than asked for', () => {
    expect(logMarks([1, 3], 9)).toEqual([1, 1.2, 1.5, 2, 3]);
    expect(logMarks([1, 1.4], 9)).toEqual([1, 1.1, 1.2, 1.3, 1.4]);
    expect([1e-12, 0.01, 1, 200, 1e6].map(markText)).toEqual(['10⁻¹²', '0.01', '1', '200', '10⁶']);
    expect(logMarks([0.5, 2], 9)).toEqual([0.5, 0.7, 1, 1.2, 1.5, 2]);
    for (const range of [[1, 1.5], [1e-9, 1], [1e-14, 1e3], [1, 1e4]] as const) {
      const marks = logMarks(range, 8);
      expect(marks.length).toBeLessThanOrEqual(8);
      expect(marks.length).toBeGreaterThanOrEqual(2);
      expect(marks.every((mark) => mark >= range[0] * 0.999 && mark <= range[1] * 1.001)).toBe(true);
    }
  });
});

function flow(residuals: number[]): ConeMetricReport {
  return { newton_steps: residuals.length - 1, cg_iterations: 40, edge_flips: 3, max_curvature_error: 0, residuals, seconds: 0.1 };
}

describe('the plot of the residuals', () => {
  const chart = residualChart({ source: flow([1, 1e-2, 1e-7, 0]), target: flow([0.5, 1e-9]) }, { source: null, target: flow([2, 1, 0.1, 1e-3, 1e-6]) });

  test('has all steps of both flows and of those before', () => {
    expect(chart?.curves.map(({ name }) => name)).toEqual(['Source', 'Target', 'Target before']);
    expect(chart?.at).toEqual([0, 1, 2, 3, 4]);
    // A residual of 0 has no logarithm, and the shorter flow ends early.
    expect(chart?.curves[0]?.values).toEqual([1, 1e-2, 1e-7, null, null]);
    expect(chart?.curves[1]?.values).toEqual([0.5, 1e-9, null, null, null]);
    expect(chart?.y.range).toEqual([1e-9, 10]);
  });

  test('is none where no flow began', () => {
    expect(residualChart({ source: null, target: null }, { source: flow([1]), target: null })).toBeNull();
  });

  test('reads its values out', () => {
    expect(chart && reading(chart, 1)).toBe('Newton step 1. Largest curvature error (rad): Source 0.01, Target 1.0·10⁻⁹, Target before 1');
    expect(chart && indexAt(chart, 1.7)).toBe(2);
  });
});

describe('a linear map', () => {
  test('is measured by its singular values', () => {
    const from = { length: 1, along: 0, height: 1 };
    expect(measure(from, from)).toEqual({ density: 1, angle: 1, area: 1 });
    const stretched = measure(from, { length: 2, along: 0, height: 1 });
    expect(stretched.density).toBeCloseTo((4 + 1 + 0.25 + 1) / 4, 12);
    expect(stretched.angle).toBeCloseTo((2 + 0.5) / 2, 12);
    expect(stretched.area).toBeCloseTo(2, 12);
    // A shear by t: s1² + s2² = 2 + t², s1 s2 = 1.
    expect(measure(from, { length: 1, along: 0.5, height: 1 }).density).toBeCloseTo((2 + 0.25) / 2, 12);
    // Renaming the corners of the triangles cyclically changes nothing.
    expect(measure({ length: 1, along: 0.5, height: 2 }, { length: 2, along: 1, height: 4 }).angle).toBeCloseTo(1, 12);
  });
});

describe('the pieces of a map', () => {
  let report: Report;
  let spectra: Spectra;
  beforeAll(async () => {
    startCoreModule();
    const demo = buildDemo('sphere-tetrahedron');
    if (demo === undefined) {
      throw new Error('the demo is gone');
    }
    const output = runMap(demo.source(), demo.target(), new TextDecoder().decode(demo.landmarks()), '{"ownCones": 0}', {
      relaxes: () => undefined,
      progress: () => undefined,
      found: () => undefined,
      preview: () => undefined,
      wantsResult: () => false,
    });
    report = JSON.parse(output.report()) as Report;
    const pieces: Pieces = { triangles: output.triangles(), places: [output.positions(0), output.positions(1)], areWhole: true };
    spectra = await spectraOf(pieces, pause);
    output.free();
  });

  test('give the numbers that the core measured', () => {
    const { mean, median, p95 } = report.distortion;
    expect(spectra.density.mean / mean).toBeCloseTo(1, 3);
    // A class is 0.23 % wide.
    expect(Math.abs(quantile(spectra.density, 0.5) / median - 1)).toBeLessThan(0.004);
    expect(Math.abs(quantile(spectra.density, 0.95) / p95 - 1)).toBeLessThan(0.004);
  });

  test('have all of the area in each spectrum, and the area of the target in their factors', () => {
    for (const { shares } of Object.values(spectra)) {
      expect(shares.reduce((sum, share) => sum + share)).toBeCloseTo(1, 9);
    }
    expect(spectra.area.mean).toBeCloseTo(1, 3);
    expect(spectra.angle.mean).toBeLessThan(spectra.density.mean);
  });

  test('fill a histogram whose bars and rest sum to 100 %, and a curve that rises there', () => {
    for (const measure of ['density', 'area'] as const) {
      const histogram = distortionChart(spectra, null, { measure, way: 'histogram' });
      const rest = beyond(spectra, histogram, measure);
      const bars = histogram.curves[0]?.values.slice(0, -1) ?? [];
      expect(bars.reduce((sum: number, value) => sum + (value ?? 0), 0) + 100 * rest).toBeCloseTo(100, 6);
      expect(rest).toBeLessThan(0.006);
      const cumulative = distortionChart(spectra, spectra, { measure, way: 'cumulative' });
      const [now, before] = cumulative.curves;
      expect(now?.values.every((value, k, all) => k === 0 || (value ?? 0) >= (all[k - 1] ?? 0))).toBe(true);
      expect(now?.values.at(-1)).toBeGreaterThan(99);
      expect(before?.values).toEqual(now?.values);
    }
  });
});

describe('the map before', () => {
  test('stays for comparison when another one comes, without its files', () => {
    const again = after(DONE, { kind: 'run-started' }, { kind: 'run-done', output: { ...OUTPUT }, report: { ...REPORT } });
    expect(DONE.earlier).toBeNull();
    expect(again.earlier).toEqual({
      name: 'cat and lion, 4 pairs',
      report: REPORT,
      pieces: { triangles: OUTPUT.triangles, places: [OUTPUT.sides[0].positions, OUTPUT.sides[1].positions], areWhole: true },
    });
    expect(again.earlier?.report).toBe(DONE.result?.report);
  });
});

const CHART: Chart = {
  id: 'test',
  title: 'A & B <c>',
  x: { title: 'Step, "n"', scale: 'linear', range: [0, 2], marks: [0, 1, 2] },
  y: { title: 'y', scale: 'log', range: [0.01, 1], marks: [0.01, 0.1, 1] },
  at: [0, 1, 2],
  curves: [
    { name: 'now', of: 'now', colour: 'first', values: [1, null, 0.01] },
    { name: 'before', of: 'before', colour: 'second', values: [0.1, 0.1, 0.1] },
  ],
  shape: 'line',
};

describe('the files of a plot', () => {
  test('are a table with a column for each curve', () => {
    expect(chartCsv(CHART)).toBe('"Step, ""n""",now,before\n0,1,0.1\n1,,0.1\n2,0.01,0.1\n');
  });

  test('are a drawing with every point in its place, and escaped words', () => {
    const svg = chartSvg(CHART);
    expect(svg).toContain('A &#38; B &#60;c&#62;');
    expect(svg).not.toMatch(/style=|<script/);
    // The gap interrupts the curve: there are two pieces of one point each, and one of three.
    const paths = [...svg.matchAll(/<path d="(M[^"]*)" fill="none" stroke="#(?:0b678a|8a5300)"/g)].map(([, d]) => d);
    expect(paths).toEqual(['M76.00 48.00', 'M704.00 380.00', 'M76.00 214.00L390.00 214.00L704.00 214.00']);
    expect([...svg.matchAll(/<circle/g)]).toHaveLength(5);
  });

  test('draw steps with their full width', () => {
    const svg = chartSvg({ ...CHART, shape: 'steps', curves: CHART.curves.slice(1) });
    expect(svg).toContain('M76.00 214.00L390.00 214.00L390.00 214.00L704.00 214.00L704.00 214.00"');
    expect(shareOf(CHART.y, 0.1)).toBeCloseTo(0.5, 12);
    expect(indexAt({ ...CHART, shape: 'steps' }, 1.9)).toBe(1);
    expect(indexAt({ ...CHART, shape: 'steps' }, 2)).toBe(1);
  });
});
