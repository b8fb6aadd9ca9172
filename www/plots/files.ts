/** A plot as SVG and CSV files. The SVG is self-contained, dark on white, for use in papers. */
import { ACCENT, DOUBT, INK, LINE, PAPER, QUIET } from '../colours.ts';
import { escaped } from '../svg.ts';
import type { Axis, Chart, Curve } from './chart.ts';
import { markText, shareOf } from './chart.ts';

/** The size of the drawing, in pixels. */
export const SIZE = { width: 720, height: 440 };
const BOX = { left: 76, right: 704, top: 48, bottom: 380 };
const COLOURS: Readonly<Record<Curve['colour'], string>> = { first: ACCENT.light, second: DOUBT.light };
/** The opacity with which the map before is drawn. */
export const FAINT = 0.45;

function across(axis: Axis, value: number): number {
  return BOX.left + shareOf(axis, value) * (BOX.right - BOX.left);
}

function down(axis: Axis, value: number): number {
  return BOX.bottom - shareOf(axis, value) * (BOX.bottom - BOX.top);
}

/** The corners of a curve's pieces: where a value is missing, the curve is interrupted. */
function pieces({ x, y, at, shape }: Chart, { values }: Curve): readonly (readonly string[])[] {
  const found: string[][] = [[]];
  values.forEach((value, k) => {
    const place = at[k];
    if (value === null || place === undefined) {
      found.push([]);
      return;
    }
    const [left, height] = [across(x, place).toFixed(2), down(y, value).toFixed(2)];
    const next = at[k + 1];
    const right = shape === 'steps' && next !== undefined ? [`${across(x, next).toFixed(2)} ${height}`] : [];
    found.at(-1)?.push(`${left} ${height}`, ...right);
  });
  return found.filter((corners) => corners.length > 0);
}

function curveMarkup(chart: Chart, curve: Curve): string {
  const colour = COLOURS[curve.colour];
  const faint = curve.of === 'before' ? ` stroke-opacity="${FAINT}" stroke-dasharray="6 4"` : '';
  const paths = pieces(chart, curve).map(
    (corners) => `<path d="M${corners.join('L')}" fill="none" stroke="${colour}" stroke-width="2" stroke-linejoin="round"${faint}/>`,
  );
  const dots = chart.shape === 'line' && chart.at.length <= 40
    ? curve.values.flatMap((value, k) =>
        value === null || chart.at[k] === undefined
          ? []
          : [`<circle cx="${across(chart.x, chart.at[k]).toFixed(2)}" cy="${down(chart.y, value).toFixed(2)}" r="3" fill="${colour}"${curve.of === 'before' ? ` fill-opacity="${FAINT}"` : ''}/>`],
      )
    : [];
  return [...paths, ...dots].join('');
}

function text(x: number, y: number, content: string, more = ''): string {
  return `<text x="${x.toFixed(2)}" y="${y.toFixed(2)}" fill="${INK.light}"${more}>${escaped(content)}</text>`;
}

function axes({ x, y }: Chart): string {
  const upright = x.marks.map((mark) => {
    const place = across(x, mark).toFixed(2);
    return `<path d="M${place} ${BOX.top}V${BOX.bottom}" stroke="${LINE.light}"/>${text(Number(place), BOX.bottom + 18, markText(mark), ' text-anchor="middle"')}`;
  });
  const level = y.marks.map((mark) => {
    const place = down(y, mark).toFixed(2);
    return `<path d="M${BOX.left} ${place}H${BOX.right}" stroke="${LINE.light}"/>${text(BOX.left - 8, Number(place) + 4, markText(mark), ' text-anchor="end"')}`;
  });
  const middle = (BOX.top + BOX.bottom) / 2;
  const titles = [
    text((BOX.left + BOX.right) / 2, BOX.bottom + 44, x.title, ' text-anchor="middle"'),
    text(0, 0, y.title, ` text-anchor="middle" transform="translate(18 ${middle}) rotate(-90)"`),
  ];
  return [...upright, ...level, `<path d="M${BOX.left} ${BOX.top}V${BOX.bottom}H${BOX.right}" fill="none" stroke="${QUIET.light}"/>`, ...titles].join('');
}

function legend({ curves }: Chart): string {
  return curves
    .map((curve, k) => {
      const left = BOX.left + k * 150;
      const faint = curve.of === 'before' ? ` stroke-opacity="${FAINT}" stroke-dasharray="6 4"` : '';
      return `<path d="M${left} 34h24" stroke="${COLOURS[curve.colour]}" stroke-width="2"${faint}/>${text(left + 30, 38, curve.name)}`;
    })
    .join('');
}

/** The plot as SVG. */
export function chartSvg(chart: Chart): string {
  const { width, height } = SIZE;
  const curves = chart.curves.map((curve) => curveMarkup(chart, curve)).join('');
  const title = text(BOX.left, 18, chart.title, ' font-weight="600"');
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12"><rect width="${width}" height="${height}" fill="${PAPER}"/>${title}${legend(chart)}${axes(chart)}${curves}</svg>\n`;
}

function cell(content: string): string {
  return /[",\n]/.test(content) ? `"${content.replaceAll('"', '""')}"` : content;
}

/** The plot's numbers as a table: x, and a column for each curve. */
export function chartCsv({ x, at, curves }: Chart): string {
  const head = [x.title, ...curves.map(({ name }) => name)].map(cell).join(',');
  const rows = at.map((place, k) => [place, ...curves.map(({ values }) => values[k] ?? '')].join(','));
  return `${[head, ...rows].join('\n')}\n`;
}
