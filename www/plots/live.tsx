/** A plot that shows its values under the mouse and by the arrow keys. */
import type { VNode } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { useDarkness } from '../darkness.ts';
import type { Axis, Chart, Curve } from './chart.ts';
import { indexAt, markText, reading } from './chart.ts';
import { FAINT } from './files.ts';

const HEIGHT = 320;
/** The most points of a curve that are drawn as dots. */
const DOTTED = 40;

/** The colours of the page's style sheets, for use on a canvas. */
interface Palette {
  readonly ink: string;
  readonly line: string;
  readonly curve: Readonly<Record<Curve['colour'], string>>;
}

function paletteOf(element: HTMLElement): Palette {
  const probe = document.createElement('span');
  element.append(probe);
  const colour = (name: string): string => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const palette = { ink: colour('quiet'), line: colour('line'), curve: { first: colour('accent'), second: colour('doubt') } };
  probe.remove();
  return palette;
}

function scaleOf({ scale, range: [low, high] }: Axis): uPlot.Scale {
  const plain: uPlot.Scale = { time: false, range: [low, high] };
  // The library's number for a logarithmic scale; its enumeration exists only among the types.
  return scale === 'log' ? Object.assign(plain, { distr: 3 }) : plain;
}

function axisOf({ title, marks }: Axis, { ink, line }: Palette, size: number): uPlot.Axis {
  return {
    label: title,
    stroke: ink,
    size,
    labelSize: 24,
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1 },
    splits: () => [...marks],
    // All marks are drawn; by default the library leaves some out on logarithmic axes.
    filter: (_, splits) => splits,
    values: (_, splits) => splits.map(markText),
  };
}

function seriesOf({ shape, at }: Chart, { name, of, colour }: Curve, palette: Palette): uPlot.Series {
  const stepped = shape === 'steps' ? uPlot.paths.stepped?.({ align: 1 }) : undefined;
  return {
    label: name,
    stroke: palette.curve[colour],
    width: 2,
    alpha: of === 'before' ? FAINT : 1,
    ...(of === 'before' ? { dash: [6, 4] } : {}),
    ...(stepped === undefined ? {} : { paths: stepped }),
    points: { show: shape === 'line' && at.length <= DOTTED, size: 6 },
  };
}

function draw(element: HTMLElement, chart: Chart, asked: (index: number | null) => void): uPlot {
  const palette = paletteOf(element);
  const options: uPlot.Options = {
    width: element.clientWidth,
    height: HEIGHT,
    scales: { x: scaleOf(chart.x), y: scaleOf(chart.y) },
    axes: [axisOf(chart.x, palette, 36), axisOf(chart.y, palette, 60)],
    series: [{}, ...chart.curves.map((curve) => seriesOf(chart, curve, palette))],
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, y: false },
    hooks: {
      setCursor: [
        (plot): void => {
          const { left } = plot.cursor;
          asked(left === undefined || left < 0 ? null : indexAt(chart, plot.posToVal(left, 'x')));
        },
      ],
    },
  };
  return new uPlot(options, [[...chart.at], ...chart.curves.map(({ values }) => [...values])], element);
}

interface LiveProps {
  readonly chart: Chart;
  /** The page's theme, on which the colours depend. */
  readonly theme: string;
}

/** The plot with the values under the mouse, or at the place that the arrow keys have reached. */
export function LivePlot({ chart, theme }: LiveProps): VNode {
  const root = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const [index, setIndex] = useState<number | null>(null);
  const isDark = useDarkness(theme);
  useEffect(() => {
    const element = root.current;
    if (element === null) {
      return undefined;
    }
    const drawn = draw(element, chart, setIndex);
    plot.current = drawn;
    const observer = new ResizeObserver(() => {
      drawn.setSize({ width: element.clientWidth, height: HEIGHT });
    });
    observer.observe(element);
    return () => {
      observer.disconnect();
      drawn.destroy();
      plot.current = null;
      setIndex(null);
    };
  }, [chart, theme, isDark]);
  const move = (to: number): void => {
    const drawn = plot.current;
    const last = chart.at.length - (chart.shape === 'steps' ? 2 : 1);
    const place = chart.at[Math.min(last, Math.max(0, to))];
    if (drawn !== null && place !== undefined) {
      // Half a pixel inside, so that the cursor selects this step and not the one before.
      drawn.setCursor({ left: drawn.valToPos(place, 'x') + 0.5, top: 1 });
    }
  };
  return (
    <>
      <div
        ref={root}
        class="live-plot"
        role="img"
        tabIndex={0}
        aria-label={`${chart.title}. ${chart.y.title} over ${chart.x.title}; the arrow keys read the values.`}
        onKeyDown={(event) => {
          const steps: Readonly<Partial<Record<string, number>>> = {
            ArrowRight: (index ?? -1) + 1,
            ArrowLeft: (index ?? 1) - 1,
            Home: 0,
            End: chart.at.length - 1,
          };
          const to = steps[event.key];
          if (to !== undefined) {
            event.preventDefault();
            move(to);
          }
        }}
      />
      <p class="reading small" role="status">
        {index === null ? 'Move the mouse over the plot, or use the arrow keys on it, to read values.' : reading(chart, index)}
      </p>
    </>
  );
}
