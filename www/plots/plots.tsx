/** The plots of a map: how its flat metrics converged, and how it distorts, with the map before it for comparison. */
import type { VNode } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import { download } from '../dom.ts';
import { figure, integer } from '../numbers.ts';
import type { ConeMetricReport, Report } from '../report.ts';
import type { EarlierMap, Pieces } from '../store/state.ts';
import type { Chart, Curve } from './chart.ts';
import type { Way } from './distortion.ts';
import { beyond, distortionChart } from './distortion.ts';
import { chartCsv, chartSvg, SIZE } from './files.ts';
import { LivePlot } from './live.tsx';
import './plots.css';
import { pngOf } from './png.ts';
import { residualChart } from './residuals.ts';
import type { Measure, Spectra } from './spectrum.ts';
import { MEASURES, quantile, spectraOf } from './spectrum.ts';

export interface PlotsProps {
  /** The map that is plotted; `null` for none. */
  readonly map: EarlierMap | null;
  /** The map before it; `null` for none. */
  readonly before: EarlierMap | null;
  readonly theme: string;
}

/** How many pixels of a PNG stand for one of the drawing. */
const PNG_TIMES = 2;

const MEASURED = new WeakMap<Uint32Array, Promise<Spectra>>();

/** The spectra of a map; they are computed only once for each map. */
function spectraOnce(pieces: Pieces): Promise<Spectra> {
  const known = MEASURED.get(pieces.triangles);
  const spectra =
    known ??
    spectraOf(pieces, () => new Promise((resolve) => {
      setTimeout(resolve);
    }));
  MEASURED.set(pieces.triangles, spectra);
  return spectra;
}

/** The spectra of a map once they are computed; `null` before that, and for a map whose pieces do not cover it. */
function useSpectra(map: EarlierMap | null): Spectra | null {
  const [found, setFound] = useState<{ readonly pieces: Pieces; readonly spectra: Spectra } | null>(null);
  const pieces = map?.pieces.areWhole === true ? map.pieces : null;
  useEffect(() => {
    let isLatest = true;
    if (pieces !== null) {
      void spectraOnce(pieces).then((spectra) => {
        if (isLatest) {
          setFound({ pieces, spectra });
        }
      });
    }
    return () => {
      isLatest = false;
    };
  }, [pieces?.triangles]);
  return pieces !== null && found?.pieces.triangles === pieces.triangles ? found.spectra : null;
}

function Key({ curve: { name, of, colour } }: { readonly curve: Curve }): VNode {
  return (
    <li class={`${colour} ${of}`}>
      <svg viewBox="0 0 24 8" aria-hidden="true">
        <path d="M0 4h24" />
      </svg>
      {name}
    </li>
  );
}

interface FigureProps {
  readonly chart: Chart;
  readonly theme: string;
  readonly caption: string;
}

/** A plot with its key, its caption and its files. */
function Figure({ chart, theme, caption }: FigureProps): VNode {
  const name = `conemap-${chart.id}`;
  const savePng = async (): Promise<void> => {
    const png = await pngOf(chartSvg(chart), SIZE, PNG_TIMES);
    if (png !== null) {
      download(`${name}.png`, 'image/png', png);
    }
  };
  const files = [
    ['PNG', savePng],
    ['SVG', (): void => { download(`${name}.svg`, 'image/svg+xml', chartSvg(chart)); }],
    ['CSV', (): void => { download(`${name}.csv`, 'text/csv', chartCsv(chart)); }],
  ] as const;
  return (
    <figure class="plot" data-plot={chart.id}>
      <ul class="key">
        {chart.curves.map((curve) => (
          <Key key={curve.name} curve={curve} />
        ))}
      </ul>
      <LivePlot chart={chart} theme={theme} />
      <figcaption class="quiet">{caption}</figcaption>
      <div class="row">
        {files.map(([format, save]) => (
          <button
            key={format}
            type="button"
            aria-label={`Save “${chart.title}” as ${format}`}
            onClick={() => {
              void save();
            }}
          >
            {format}
          </button>
        ))}
      </div>
    </figure>
  );
}

function flowWords(name: string, flow: ConeMetricReport | null): string {
  return flow === null
    ? `${name}: none.`
    : `${name}: ${integer(flow.newton_steps)} Newton steps, ${integer(flow.cg_iterations)} iterations of conjugate gradients, ${integer(flow.edge_flips)} edge flips.`;
}

function Residuals({ report, before, theme }: { readonly report: Report; readonly before: Report | null; readonly theme: string }): VNode {
  const chart = useMemo(() => residualChart(report.cone_metric, before?.cone_metric ?? null), [report, before]);
  const { source, target } = report.cone_metric;
  return (
    <section>
      <h3>Convergence of the flat metrics</h3>
      {chart === null ? (
        <p class="quiet">This map has no flat metrics.</p>
      ) : (
        <Figure chart={chart} theme={theme} caption={`${flowWords('Source', source)} ${flowWords('Target', target)}`} />
      )}
    </section>
  );
}

interface RadioProps<T extends string> {
  readonly label: string;
  readonly value: T;
  readonly choices: readonly (readonly [T, string])[];
  readonly onChoice: (value: T) => void;
}

function Radios<T extends string>({ label, value, choices, onChoice }: RadioProps<T>): VNode {
  return (
    <fieldset>
      <legend class="unseen">{label}</legend>
      {choices.map(([choice, text]) => (
        <label key={choice} class="check">
          <input
            type="radio"
            name={`plot-${label}`}
            checked={choice === value}
            onChange={() => {
              onChoice(choice);
            }}
          />
          <span>{text}</span>
        </label>
      ))}
    </fieldset>
  );
}

const MEASURE_NAMES: Readonly<Record<Measure, string>> = { density: 'All', angle: 'Angles', area: 'Area' };
const WAYS = [['histogram', 'Histogram'], ['cumulative', 'Cumulative']] as const;

function captionOf(spectra: Spectra, chart: Chart, measure: Measure, hasCaps: boolean): string {
  const spectrum = spectra[measure];
  const outside = 100 * beyond(spectra, chart, measure);
  const rest = outside < 0.005 ? '' : ` ${outside.toFixed(2)} % of the area lies beyond the plot.`;
  const caps = hasCaps ? ' Caps over holes are counted like skin here.' : '';
  return `By area of the source, both meshes scaled to area 1. Mean ${figure(spectrum.mean)}, median ${quantile(spectrum, 0.5).toFixed(3)}, 95 % below ${quantile(spectrum, 0.95).toFixed(3)}.${rest}${caps}`;
}

function Distortion({ map, before, theme }: { readonly map: EarlierMap; readonly before: EarlierMap | null; readonly theme: string }): VNode {
  const [measure, setMeasure] = useState<Measure>('density');
  const [way, setWay] = useState<Way>('histogram');
  const now = useSpectra(map);
  const earlier = useSpectra(before);
  const chart = useMemo(() => (now === null ? null : distortionChart(now, earlier, { measure, way })), [now, earlier, measure, way]);
  return (
    <section>
      <h3>Distortion</h3>
      {!map.pieces.areWhole && <p class="quiet">The pieces of this map are not known, so its distortion is not plotted.</p>}
      {map.pieces.areWhole && chart === null && <p role="status">Measuring the pieces…</p>}
      {now !== null && chart !== null && (
        <>
          <div class="ways">
            <Radios label="Measure" value={measure} choices={MEASURES.map((name) => [name, MEASURE_NAMES[name]] as const)} onChoice={setMeasure} />
            <Radios label="Kind of plot" value={way} choices={WAYS} onChoice={setWay} />
          </div>
          <Figure chart={chart} theme={theme} caption={captionOf(now, chart, measure, map.report.coverage !== null)} />
        </>
      )}
    </section>
  );
}

/** All plots. */
export default function Plots({ map, before, theme }: PlotsProps): VNode {
  if (map === null) {
    return <p class="quiet">There is no map yet.</p>;
  }
  return (
    <div class="plots">
      <p>
        The map: {map.name}.{' '}
        {before === null ? 'Make another one, with other landmarks or choices, and both are shown.' : `Before, faint: ${before.name}.`}
      </p>
      <Distortion map={map} before={before} theme={theme} />
      <Residuals report={map.report} before={before?.report ?? null} theme={theme} />
    </div>
  );
}
