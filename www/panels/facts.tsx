/** All numbers of a result, named in the words of the method. */
import type { VNode } from 'preact';
import { Fragment } from 'preact';
import { stageName } from '../messages.ts';
import { figure, integer, percent } from '../numbers.ts';
import type { ConeMetricReport, CoverageReport, LayoutSearchReport, Report } from '../report.ts';

interface Fact {
  readonly name: string;
  readonly value: string;
  readonly note?: string;
}

/** A sentence about the search among the layouts. */
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

/** A sentence about how much of each skin has a partner on the other's. */
export function coverageSentence({ source, target }: CoverageReport): string {
  return `${percent(source)} of the source’s skin lies on skin, ${percent(target)} of the target’s is met by skin`;
}

/** The largest curvature error with which a flow ended. */
function curvatureError(flow: ConeMetricReport | null): string {
  return flow === null ? 'none' : `${figure(flow.max_curvature_error)} rad`;
}

function qualityFacts({ distortion, cone_metric: flows, base_domain: base }: Report): Fact[] {
  return [
    { name: 'Energy', value: figure(distortion.energy), note: 'Symmetric Dirichlet energy; 4 is the least, and would keep every angle' },
    {
      name: 'Distortion',
      value: `mean ${figure(distortion.mean)}, median ${figure(distortion.median)}, 95 % below ${figure(distortion.p95)}, at most ${figure(distortion.max)}`,
      note: '1 would be an isometry',
    },
    {
      name: 'Curvature error',
      value: `source ${curvatureError(flows.source)}, target ${curvatureError(flows.target)}`,
      note: 'Largest difference from the wanted cone angles',
    },
    { name: 'Base domain', value: `${integer(base.vertices)} vertices, ${integer(base.faces)} triangles` },
  ];
}

function optionalFacts({ own_landmarks: own, layout, certificate, coverage, ground_truth: truth }: Report): Fact[] {
  const inArea = 'In units of the square root of the area';
  return [
    ...(coverage === null
      ? []
      : [{ name: 'Coverage', value: coverageSentence(coverage), note: 'The rest lies in caps over holes; all other numbers are measured where skin lies on skin' }]),
    ...(own > 0 ? [{ name: 'Own cones', value: `${integer(own)} of the program’s own`, note: 'Points added at ends of limbs without a landmark, and where the landmarks are few' }] : []),
    ...(layout === null
      ? []
      : [
          {
            name: 'Layout',
            value: layoutSentence(layout),
            note: 'Ways to draw the base domain, judged by the mean logarithm of the distortion of coarse maps',
          },
        ]),
    ...(certificate === null
      ? []
      : [
          certificate.max_landmark_error === 0
            ? { name: 'Landmarks', value: 'met exactly' }
            : { name: 'Landmarks', value: `met within ${figure(certificate.max_landmark_error)}`, note: inArea },
        ]),
    ...(truth === null ? [] : [{ name: 'True images', value: `mean ${figure(truth.mean)}, 95 % below ${figure(truth.p95)} away`, note: inArea }]),
  ];
}

function Facts({ facts }: { readonly facts: readonly Fact[] }): VNode {
  return (
    <dl class="facts">
      {facts.map(({ name, value, note }) => (
        <Fragment key={name}>
          <dt>{name}</dt>
          <dd>
            {value}
            {note !== undefined && <small>{note}</small>}
          </dd>
        </Fragment>
      ))}
    </dl>
  );
}

/** The numbers of a report. */
export function ReportFacts({ report }: { readonly report: Report }): VNode {
  return <Facts facts={[...qualityFacts(report), ...optionalFacts(report)]} />;
}

/** The seconds of each stage. */
export function ReportTimes({ report }: { readonly report: Report }): VNode {
  const stages = Object.entries(report.seconds).filter(([stage]) => stage !== 'total');
  const total = report.seconds['total'] ?? stages.reduce((sum, [, seconds]) => sum + seconds, 0);
  return (
    <>
      <h3>Computed in {total.toFixed(1)} seconds</h3>
      <Facts facts={stages.map(([stage, seconds]) => ({ name: stageName(stage), value: `${seconds.toFixed(2)} s` }))} />
    </>
  );
}
