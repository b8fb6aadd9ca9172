/** The certificate as a shield that opens its details, and a button that has the map checked by a second program. */
import type { VNode } from 'preact';
import { figure, integer } from '../numbers.ts';
import type { CertificateReport } from '../report.ts';
import type { MapProof, Result } from '../store/state.ts';
import type { Actions } from './actions.ts';
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

interface SecondProofProps {
  /** The second program's verdict on this map; `null` where it was not asked. */
  readonly proof: MapProof | null;
  readonly actions: Actions;
}

/** The second program's answer, or the button that asks it. */
function SecondProof({ proof, actions }: SecondProofProps): VNode {
  if (proof === null) {
    return (
      <div class="row">
        <button type="button" id="prove" onClick={actions.proveMap} title="By another program, which reads only the map file and both meshes, in exact arithmetic">
          Prove it again, exactly
        </button>
      </div>
    );
  }
  return (
    <p id="second-proof" role="status" class={proof.answer?.verdict === 'refused' ? 'warning' : ''}>
      {proof.answer === null ? 'A second program looks at every piece…' : proof.answer.sentence}
    </p>
  );
}

interface CertificateProps extends SecondProofProps {
  readonly result: Result;
}

/** The shield. */
export function Certificate({ result, proof, actions }: CertificateProps): VNode {
  const { report, output } = result;
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
        {output.map !== null && <SecondProof proof={proof} actions={actions} />}
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
