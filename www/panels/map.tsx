/** The third step, Map: how good the map is, and what may be wrong with it. */
import type { VNode } from 'preact';
import { reopenedSentence, SENTENCES, staleSentence } from '../messages.ts';
import { isMapless, shownResult, staleness } from '../store/staleness.ts';
import type { Demo, MapProof, Result } from '../store/state.ts';
import type { Actions, PartProps } from './actions.ts';
import { Certificate } from './certificate.tsx';
import { Choices } from './choices.tsx';
import { Fold } from './controls.tsx';
import { EnergyCurve } from './energy.tsx';
import { ReportFacts, ReportTimes } from './facts.tsx';
import { Findings } from './findings.tsx';
import { Icon } from './icons.tsx';
import { choose } from './inputs.tsx';
import { DoubtfulLandmarks } from './matching.tsx';
import { PlotsButton } from './plots-dialog.tsx';
import { verdictOf } from './verdict.ts';
import { WorstPlaces } from './worst.tsx';

function Note({ sentence }: { readonly sentence: string }): VNode {
  return (
    <div class="note warning">
      <Icon name="doubt" />
      <p>{sentence}</p>
    </div>
  );
}

interface ResultProps {
  readonly result: Result;
  /** Why the map is outdated; `null` where it is not. */
  readonly stale: string | null;
  /** The verdict of a second program on the map; `null` where it was not asked. */
  readonly proof: MapProof | null;
  readonly actions: Actions;
}

function ResultSection({ result, stale, proof, actions }: ResultProps): VNode {
  const { report } = result;
  const { level, sentence, more } = verdictOf(report);
  return (
    <section id="result" class={stale === null ? '' : 'outdated'} aria-live="polite">
      {stale !== null && <Note sentence={stale} />}
      <div class={`verdict dimmed ${level}`}>
        <p class="sentence">{sentence}</p>
        <p class="quiet">{more}</p>
        <Certificate result={result} proof={proof} actions={actions} />
        {result.opened !== null && <p class="quiet" id="reopened">{reopenedSentence(result.opened.name)}</p>}
        {result.opened?.isMirrored === true && <Note sentence={SENTENCES.mirroredMap} />}
        {report.warnings.map((warning) => (
          <Note key={warning.kind} sentence={warning.sentence} />
        ))}
      </div>
      <WorstPlaces result={result} actions={actions} />
    </section>
  );
}

function AboutDemo({ demo }: { readonly demo: Demo }): VNode {
  return (
    <section>
      <h3>A demo</h3>
      <p class="quiet">{demo.sentence}.</p>
      <div class="row">
        <button
          type="button"
          onClick={() => {
            choose('mesh-files');
          }}
        >
          Try your own meshes…
        </button>
      </div>
    </section>
  );
}

/** The content of the panel. */
export function MapPanel({ state, actions, shell }: PartProps): VNode {
  const result = shownResult(state);
  const changes = staleness(state);
  return (
    <div class="content">
      {state.job.kind === 'running' && (
        <section hidden={state.job.energies.flat().length < 2}>
          <h3>The map becomes smoother</h3>
          <EnergyCurve energies={state.job.energies} />
        </section>
      )}
      <DoubtfulLandmarks state={state} actions={actions} />
      <Findings state={state} actions={actions} />
      {result !== null && (
        <ResultSection
          result={result}
          stale={changes === null ? null : staleSentence(changes)}
          proof={state.proof?.of === result ? state.proof : null}
          actions={actions}
        />
      )}
      {result === null && isMapless(state) && <Note sentence={SENTENCES.mapNotKept} />}
      {result === null && state.job.kind !== 'running' && (
        <p class="quiet">{state.result !== null && SENTENCES.mapOfOthers} The map gives every point of the source its partner on the target, through all landmark pairs.</p>
      )}
      {state.demo !== null && state.job.kind !== 'running' && <AboutDemo demo={state.demo} />}
      <section id="details">
        <Fold title="Details">
          <h3>How the map is made</h3>
          <Choices state={state} actions={actions} />
          {result !== null && (
            <>
              <h3>All numbers</h3>
              <ReportFacts report={result.report} />
              <ReportTimes report={result.report} />
              <div class="row">
                <PlotsButton shell={shell} />
                <button
                  type="button"
                  id="show-base-domain"
                  onClick={() => {
                    actions.dispatch({ kind: 'ui', ui: { step: 'method', panel: 'open' } });
                  }}
                >
                  <Icon name="method" />
                  Base domain
                </button>
              </div>
            </>
          )}
        </Fold>
      </section>
    </div>
  );
}
