/** The certificate as a shield that opens its proof. */
import type { VNode } from 'preact';
import { figure, integer } from '../numbers.ts';
import type { CertificateReport, Report } from '../report.ts';
import { Icon } from './icons.tsx';

function flips({ flipped_triangles: flipped, triangles }: CertificateReport): string {
  return `${integer(flipped)} of ${integer(triangles)} triangles flipped`;
}

function Proof({ certificate, early }: { readonly certificate: CertificateReport; readonly early: boolean }): VNode {
  const error = certificate.max_landmark_error;
  return (
    <div>
      <p>
        Certified bijective{early ? ' (finished early)' : ''}: {flips(certificate)}.
      </p>
      <p class="quiet">
        Every point of the source has exactly one partner on the target, and the other way round: a check that knows nothing of
        how the map was made has looked at every triangle of both meshes.
      </p>
      <dl class="facts">
        <dt>Landmarks</dt>
        <dd>{error === 0 ? 'met exactly' : `met within ${figure(error)} of the root of the area`}</dd>
        <dt>Angle sums</dt>
        <dd>right within {figure(certificate.max_angle_sum_error)} rad</dd>
      </dl>
    </div>
  );
}

/** The shield. */
export function Certificate({ report }: { readonly report: Report }): VNode {
  const { certificate } = report;
  if (certificate?.bijective === true) {
    return (
      <details class="shield">
        <summary>
          <Icon name="shield" />
          Certified one-to-one
          <Icon name="turn" turns />
        </summary>
        <Proof certificate={certificate} early={report.stopped_early} />
      </details>
    );
  }
  return (
    <details class="shield open-question">
      <summary>
        <Icon name="doubt" />
        Not certified
        <Icon name="turn" turns />
      </summary>
      <div>
        <p>
          {certificate === null
            ? 'This method does not guarantee that every point has exactly one partner; the relaxed one does.'
            : `Not certified: ${flips(certificate)}.`}
        </p>
      </div>
    </details>
  );
}
