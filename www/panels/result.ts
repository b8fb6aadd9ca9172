/** The result in words and its downloads. */
import { stageName, staleSentence } from '../messages.ts';
import type { ConeMetricReport, LayoutSearchReport, Report } from '../report.ts';
import { figure, integer } from '../numbers.ts';
import { shownResult, staleness } from '../store/staleness.ts';
import type { Result, State } from '../store/state.ts';
import { byId, button, download, make } from '../dom.ts';
import type { Panel } from './panel.ts';

function verdict(report: Report): HTMLElement {
  const { certificate } = report;
  if (certificate === null) {
    const share = report.unmapped_share;
    const text =
      share > 0
        ? `Not certified: this method left ${(100 * share).toFixed(share < 0.01 ? 2 : 1)} % of the source without an image.`
        : 'Not certified: every vertex of the source has an image, but the map need not be one-to-one.';
    return make('p', { class: 'verdict open' }, text);
  }
  const flips = `${integer(certificate.flipped_triangles)} of ${integer(certificate.triangles)} triangles flipped`;
  const early = report.stopped_early ? ' (finished early)' : '';
  return certificate.bijective
    ? make('p', { class: 'verdict good' }, `Certified bijective${early}: ${flips}`)
    : make('p', { class: 'verdict open' }, `Not certified: ${flips}`);
}

/** The search among the layouts in words. */
function layoutSentence(layout: LayoutSearchReport): string {
  const judged = layout.judged === 1 ? 'one class tried' : `best of ${integer(layout.judged)} classes tried`;
  const words = [layout.judged === 0 ? 'drawn from the base domain' : judged];
  if (layout.mean_log !== null && layout.runner_up !== null) {
    words.push(`mean log distortion ${figure(layout.mean_log)}, next best ${figure(layout.runner_up)}`);
  }
  if (layout.twists > 0) {
    words.push(`${integer(layout.twists)} ${layout.twists === 1 ? 'twist' : 'twists'} made`);
  }
  words.push(`longest path ${layout.path_stretch.toFixed(2)} times its shortest`);
  return words.join('; ');
}

/** How far a flow ended from its cone angles. */
function curvatureError(flow: ConeMetricReport | null): string {
  return flow === null ? 'none' : `${figure(flow.max_curvature_error)} rad`;
}

function facts(report: Report): (readonly [string, string, string])[] {
  const { distortion, cone_metric: flows, certificate } = report;
  const rows: (readonly [string, string, string])[] = [
    ['Energy', figure(distortion.energy), 'Symmetric Dirichlet energy; 4 would be an isometry'],
    [
      'Distortion',
      `mean ${figure(distortion.mean)}, median ${figure(distortion.median)}, 95 % below ${figure(distortion.p95)}`,
      '1 would be an isometry',
    ],
    [
      'Curvature error',
      `source ${curvatureError(flows.source)}, target ${curvatureError(flows.target)}`,
      'Largest difference from the wanted cone angles',
    ],
    ['Base domain', `${integer(report.base_domain.vertices)} vertices, ${integer(report.base_domain.faces)} triangles`, ''],
  ];
  if (report.own_landmarks > 0) {
    rows.push(['Own cones', `${integer(report.own_landmarks)} of the program’s own`, 'Points added where the landmarks are few']);
  }
  if (report.layout !== null) {
    rows.push(['Layout', layoutSentence(report.layout), 'Ways to draw the base domain, judged by the mean logarithm of the distortion of coarse maps']);
  }
  if (certificate !== null) {
    const error = certificate.max_landmark_error;
    rows.push(
      error === 0
        ? ['Landmarks', 'met exactly', '']
        : ['Landmarks', `met within ${figure(error)}`, 'In units of the square root of the area'],
    );
  }
  if (report.ground_truth !== null) {
    const truth = report.ground_truth;
    rows.push([
      'True images',
      `mean ${figure(truth.mean)}, 95 % below ${figure(truth.p95)} away`,
      'In units of the square root of the area',
    ]);
  }
  return rows;
}

function times(report: Report): HTMLElement {
  const entries = Object.entries(report.seconds);
  const total = report.seconds['total'] ?? entries.reduce((sum, [, value]) => sum + value, 0);
  const rows = entries
    .filter(([stage]) => stage !== 'total')
    .flatMap(([stage, value]) => [make('dt', {}, stageName(stage)), make('dd', {}, `${value.toFixed(2)} s`)]);
  return make(
    'details',
    {},
    make('summary', {}, `Computed in ${total.toFixed(1)} seconds`),
    make('dl', {}, ...rows),
  );
}

function downloads(result: Result): HTMLElement {
  const { output } = result;
  const file = (text: string, title: string, name: string, type: string, data: BlobPart): HTMLElement =>
    button(text, () => {
      download(name, type, data);
    }, { title });
  return make(
    'div',
    { class: 'row', role: 'group', 'aria-label': 'Downloads' },
    file('GLB', 'The source with the texture of the target', 'conemap.glb', 'model/gltf-binary', output.glb),
    file('CSV', 'The image of every vertex of the source', 'conemap.csv', 'text/csv', output.csv),
    file('Base OBJ', 'The base domain', 'base-domain.obj', 'model/obj', output.baseObj),
    file('Report', 'All numbers as JSON', 'report.json', 'application/json', output.report),
  );
}

/** Makes the panel. */
export function resultPanel(): Panel {
  const root = byId('result');
  const stale = make('p', { class: 'quiet' });
  return {
    render(state: State, previous: State | null): void {
      const changes = staleness(state);
      stale.hidden = changes === null;
      stale.textContent = changes === null ? '' : staleSentence(changes);
      const result = shownResult(state);
      if (previous !== null && shownResult(previous) === result) {
        return;
      }
      root.hidden = result === null;
      if (result === null) {
        root.replaceChildren();
        return;
      }
      const { report } = result;
      const rows = facts(report).flatMap(([name, value, note]) => [
        make('dt', note === '' ? {} : { title: note }, name),
        make('dd', {}, value, ...(note === '' ? [] : [make('small', {}, note)])),
      ]);
      root.replaceChildren(
        make('h2', {}, 'Result'),
        verdict(report),
        stale,
        ...report.warnings.map(({ sentence }) => make('p', { class: 'warning' }, sentence)),
        make('dl', {}, ...rows),
        times(report),
        downloads(result),
      );
    },
  };
}
