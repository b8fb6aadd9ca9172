/** Plots of a map's distortion: how the area is distributed over its values, or how much of the area stays below each value. */
import type { Chart, Curve } from './chart.ts';
import { evenMarks, logMarks } from './chart.ts';
import type { Measure, Spectra, Spectrum } from './spectrum.ts';
import { CLASSES_PER_DECADE, quantile } from './spectrum.ts';

export type Way = 'histogram' | 'cumulative';

/** The number of bars of a histogram. */
const BARS = 48;
/** The share of the area that lies within the axis; single places beyond it would compress everything else. */
const SEEN = 0.995;

const TITLES: Readonly<Record<Measure, string>> = {
  density: 'Distortion D (1: none)',
  angle: 'Distortion of angles (1: none)',
  area: 'Factor of the area (1: unchanged)',
};

/** The bars of a histogram: the index of the first bar's first fine class, and the number of fine classes in each bar. */
interface Bars {
  readonly from: number;
  readonly width: number;
}

/** Bars that cover nearly all of every spectrum, from 1 on, or as far below 1 as above it. */
function barsOf(spectra: readonly Spectrum[], measure: Measure): Bars {
  const { first } = spectra[0] ?? { first: 0 };
  const one = -first * CLASSES_PER_DECADE;
  const reach = (share: number): number =>
    Math.max(...spectra.map((spectrum) => Math.abs(Math.log10(quantile(spectrum, share)))));
  if (measure === 'area') {
    const far = Math.max(reach((1 - SEEN) / 2), reach((1 + SEEN) / 2));
    const width = Math.max(1, Math.ceil((2 * far * CLASSES_PER_DECADE) / BARS));
    return { from: one - (width * BARS) / 2, width };
  }
  return { from: one, width: Math.max(1, Math.ceil((reach(SEEN) * CLASSES_PER_DECADE) / BARS)) };
}

/** The share of the area in the fine classes from one index up to, but without, another. */
function shareBetween({ shares }: Spectrum, from: number, to: number): number {
  return shares.subarray(Math.max(0, from), Math.max(0, to)).reduce((sum, share) => sum + share, 0);
}

function edges({ from, width }: Bars): readonly number[] {
  return Array.from({ length: BARS + 1 }, (_, k) => from + k * width);
}

function valuesOf(spectrum: Spectrum, bars: Bars, way: Way): readonly (number | null)[] {
  const ends = edges(bars);
  return ends.map((edge, k) => {
    if (way === 'cumulative') {
      return 100 * shareBetween(spectrum, 0, edge);
    }
    const next = ends[k + 1];
    // The last edge ends the last bar, and is drawn at that bar's height.
    return next === undefined
      ? 100 * shareBetween(spectrum, edge - bars.width, edge)
      : 100 * shareBetween(spectrum, edge, next);
  });
}

interface Asked {
  readonly measure: Measure;
  readonly way: Way;
}

/** The plot of one measure for the present map and the one before it. */
export function distortionChart(now: Spectra, before: Spectra | null, { measure, way }: Asked): Chart {
  const spectra = [now[measure], ...(before === null ? [] : [before[measure]])];
  const bars = barsOf(spectra, measure);
  const { first } = now[measure];
  const at = edges(bars).map((edge) => 10 ** (first + edge / CLASSES_PER_DECADE));
  const range = [at[0] ?? 1, at.at(-1) ?? 10] as const;
  const curves = spectra.map((spectrum, k): Curve => {
    const of = k === 0 ? 'now' : 'before';
    return { name: k === 0 ? 'This map' : 'Before', of, colour: k === 0 ? 'first' : 'second', values: valuesOf(spectrum, bars, way) };
  });
  const highest = Math.max(...curves.flatMap(({ values }) => values.map((value) => value ?? 0)));
  const top = way === 'cumulative' ? 100 : (evenMarks([0, 1.25 * highest], 5).findLast((mark) => mark >= highest) ?? 1.05 * highest);
  return {
    id: `${measure}-${way}`,
    title: way === 'histogram' ? 'How the area is distorted' : 'How much of the area is distorted less',
    x: { title: TITLES[measure], scale: 'log', range, marks: logMarks(range, 9) },
    y: {
      title: way === 'histogram' ? 'Area in each bar (%)' : 'Area with less (%)',
      scale: 'linear',
      range: [0, top],
      marks: evenMarks([0, top], 5),
    },
    at,
    curves,
    shape: way === 'histogram' ? 'steps' : 'line',
  };
}

/** The share of the present map's area that lies beyond the plot's last value. */
export function beyond(now: Spectra, chart: Chart, measure: Measure): number {
  const { first, shares } = now[measure];
  const edge = Math.round((Math.log10(chart.at.at(-1) ?? 1) - first) * CLASSES_PER_DECADE);
  const [low] = chart.at;
  const under = measure === 'area' ? shareBetween(now[measure], 0, Math.round((Math.log10(low ?? 1) - first) * CLASSES_PER_DECADE)) : 0;
  return under + shareBetween(now[measure], edge, shares.length);
}
