/** The content of a plot, whatever draws it. */
import { figure } from '../numbers.ts';

export interface Axis {
  /** The title with its unit, as it stands beside the axis. */
  readonly title: string;
  readonly scale: 'linear' | 'log';
  /** The least and the largest value. */
  readonly range: readonly [number, number];
  /** The values at which the axis has marks. */
  readonly marks: readonly number[];
}

export interface Curve {
  readonly name: string;
  /** Whether the curve is that of the map on the page, or of the one before it, which is drawn faintly. */
  readonly of: 'now' | 'before';
  /** The colour of the curve. */
  readonly colour: 'first' | 'second';
  /** A value for each x; `null` where there is none. */
  readonly values: readonly (number | null)[];
}

export interface Chart {
  /** The id, which is used in file names. */
  readonly id: string;
  readonly title: string;
  readonly x: Axis;
  readonly y: Axis;
  /** The values of x, in increasing order. */
  readonly at: readonly number[];
  readonly curves: readonly Curve[];
  /** `line` joins the points by lines; `steps` draws each value from its x to the next. */
  readonly shape: 'line' | 'steps';
}

/** Even marks at multiples of 1, 2 or 5 times a power of ten, about `count` of them. */
export function evenMarks([low, high]: readonly [number, number], count: number): readonly number[] {
  const rough = (high - low) / Math.max(1, count);
  if (!(rough > 0)) {
    return [low];
  }
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5].find((factor) => factor * power >= rough * 0.999) ?? 10) * power;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** The factors between marks of a logarithmic axis within a power of ten, the finest first. */
const FINE = [1, 1.2, 1.5, 2, 3, 5, 7];
const LOG_STEPS: readonly (readonly number[])[] = [FINE, [1, 1.5, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]];

function logMarksAt([low, high]: readonly [number, number], steps: readonly number[], everyPower: number): readonly number[] {
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  const powers = Array.from({ length: last - first + 1 }, (_, k) => first + k).filter((power) => power % everyPower === 0);
  return powers
    .flatMap((power) => steps.map((step) => Number((step * 10 ** power).toPrecision(6))))
    .filter((mark) => mark >= low * (1 - 1e-9) && mark <= high * (1 + 1e-9));
}

/** The text of a mark: a very small or large power of ten is written as such. */
export function markText(mark: number): string {
  return figure(mark).replace(/^1(?:\.0)?·(?=10)/, '');
}

/** At most `most` marks of a logarithmic axis between positive values. */
export function logMarks(range: readonly [number, number], most: number): readonly number[] {
  const [low, high] = range;
  const ways = [
    // A short logarithmic axis is nearly even.
    ...(high < 2 * low ? [evenMarks(range, 6)] : []),
    ...LOG_STEPS.map((steps) => logMarksAt(range, steps, 1)),
    ...[2, 3, 5, 10].map((every) => logMarksAt(range, [1], every)),
  ];
  return ways.find((marks) => marks.length <= most) ?? [low];
}

/** The place of a value on an axis, from 0 at its beginning to 1 at its end. */
export function shareOf({ scale, range: [low, high] }: Axis, value: number): number {
  return scale === 'log' ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

/** A sentence about the values at one place of a plot. */
export function reading({ x, y, at, curves, shape }: Chart, index: number): string {
  const place = at[index];
  if (place === undefined) {
    return '';
  }
  const next = at[index + 1];
  const where = shape === 'steps' && next !== undefined ? `${figure(place)} to ${figure(next)}` : figure(place);
  const values = curves.flatMap(({ name, values: of }) => {
    const value = of[index] ?? null;
    return value === null ? [] : [`${name} ${figure(value)}`];
  });
  return `${x.title} ${where}. ${y.title}: ${values.length === 0 ? 'none' : values.join(', ')}`;
}

/** The index of the place that belongs to a value of x: the nearest one, or the beginning of the step that it lies in. */
export function indexAt({ at, shape, x }: Chart, value: number): number {
  if (shape === 'steps') {
    const found = at.findLastIndex((place) => place <= value);
    // The last place is only the end of the last step.
    return Math.min(Math.max(0, found), at.length - 2);
  }
  const shares = at.map((place) => Math.abs(shareOf(x, place) - shareOf(x, value)));
  return shares.indexOf(Math.min(...shares));
}
