/** Landmarks that the program finds: the search, how sure it is, and what else it found. */
import type { VNode } from 'preact';
import { count } from '../messages.ts';
import type { MatchReport, Question } from '../report.ts';
import type { Found } from '../store/matching.ts';
import { canSearch } from '../store/search.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';
import type { IconName } from './icons.tsx';
import { meshName } from './names.ts';

type Props = Pick<PartProps, 'state' | 'actions'>;

/** Alternatives that are listed. */
const LISTED = 5;

/** How sure a search is, for the eye and in a word. */
const VERDICTS: Readonly<Record<MatchReport['verdict']['kind'], { readonly icon: IconName; readonly word: string }>> = {
  sure: { icon: 'check', word: 'Sure' },
  doubtful: { icon: 'doubt', word: 'Doubtful' },
  unknown: { icon: 'help', word: 'Not found' },
};

/** The button; while a search goes on, its progress and the way out. */
export function FindLandmarks({ state, actions }: Props): VNode {
  const { matching } = state;
  if (matching?.kind === 'searching') {
    return (
      <div class="searching row">
        <progress max={1} value={matching.share} aria-label="Progress of the search for landmarks" />
        <button
          type="button"
          id="stop-search"
          onClick={() => {
            actions.dispatch({ kind: 'search-closed' });
          }}
        >
          Stop looking
        </button>
      </div>
    );
  }
  return (
    <button
      type="button"
      class="find-landmarks"
      title="Find pairs at the ends of limbs by the shapes of both meshes; the pairs that are there stay"
      disabled={!canSearch(state)}
      onClick={actions.findLandmarks}
    >
      Find landmarks
    </button>
  );
}

/** The question that settles a doubt: the same place of the source, here or there on the target. */
function Asked({ question, state, actions }: { readonly question: Question } & Props): VNode {
  const { source, targets, rival } = question;
  const [here, there] = targets;
  const look = (target: number, word: string): VNode => (
    <button
      type="button"
      class="bare"
      onClick={() => {
        actions.lookAtPlaces([source, target]);
      }}
    >
      Show {word}
    </button>
  );
  const settle = (candidate: number, word: string): VNode => (
    <button
      type="button"
      onClick={() => {
        actions.dispatch({ kind: 'candidate-taken', candidate });
      }}
    >
      It belongs {word}
    </button>
  );
  return (
    <div class="question" role="group" aria-label="Which place is right?">
      <p>
        Vertex {source} of the {meshName(state, 0)}: does it belong to vertex {here} of the {meshName(state, 1)}, or to vertex{' '}
        {there}?
      </p>
      <div class="row">
        {look(here, 'the first')}
        {settle(0, 'to the first')}
      </div>
      <div class="row">
        {look(there, 'the second')}
        {settle(rival, 'to the second')}
      </div>
    </div>
  );
}

/** Other pairs that were found, the best first. */
function Alternatives({ found, actions }: { readonly found: Found } & Pick<Props, 'actions'>): VNode | null {
  const { report, taken } = found;
  const others = report.candidates.slice(0, LISTED + 1);
  if (others.length < 2) {
    return null;
  }
  return (
    <details>
      <summary>{count(others.length - 1, 'other answer')}</summary>
      <ol class="alternatives">
        {others.map(({ score, difference }, number) => (
          <li key={number}>
            <button
              type="button"
              class="bare"
              aria-pressed={taken === number}
              onClick={() => {
                actions.dispatch({ kind: 'candidate-taken', candidate: number });
              }}
            >
              {difference === null ? 'The best answer.' : difference.sentence} <span class="quiet">{score.toFixed(2)}</span>
            </button>
          </li>
        ))}
      </ol>
      <p class="quiet small">A smaller number is a better fit.</p>
    </details>
  );
}

/** What was found, and how sure it is; nothing before a search. */
export function Matched({ state, actions }: Props): VNode | null {
  const { matching } = state;
  if (matching?.kind !== 'found') {
    return null;
  }
  const { verdict } = matching.report;
  const { icon, word } = VERDICTS[verdict.kind];
  return (
    <section class="matched" aria-label="Landmarks that were found">
      <p role="status" class={`verdict of-${verdict.kind}`}>
        <Icon name={icon} /> <strong>{word}.</strong> {verdict.sentence}
      </p>
      {verdict.question !== null && <Asked question={verdict.question} state={state} actions={actions} />}
      <Alternatives found={matching} actions={actions} />
      <button
        type="button"
        class="bare"
        onClick={() => {
          actions.dispatch({ kind: 'search-closed' });
        }}
      >
        Hide
      </button>
    </section>
  );
}
