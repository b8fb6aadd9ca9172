/** The search for landmarks by the program: how sure its answer is, and the other answers. */
import type { VNode } from 'preact';
import type { Side } from '../landmarks.ts';
import { count } from '../messages.ts';
import type { MatchReport, Question } from '../report.ts';
import type { Found } from '../store/matching.ts';
import { answered, canSearch, isDoubtful, listed, takenCandidate } from '../store/search.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { AnswerPicture } from './answer-picture.tsx';
import { Fold } from './controls.tsx';
import { Icon } from './icons.tsx';
import type { IconName } from './icons.tsx';
import { meshName } from './names.ts';

type Props = Pick<PartProps, 'state' | 'actions'>;

/** The most alternatives that are listed. */
const LISTED = 5;

interface Told {
  readonly icon: IconName;
  readonly word: string;
  readonly sentence: string;
}

/** A sentence about how sure a search is. */
const VERDICTS: Readonly<Record<MatchReport['verdict']['kind'], Told>> = {
  sure: { icon: 'check', word: 'Sure.', sentence: 'No other answer comes near.' },
  doubtful: { icon: 'doubt', word: 'Doubtful.', sentence: 'It may be right. The question below settles it.' },
  mirrored: {
    icon: 'doubt',
    word: 'Mirrored.',
    sentence: 'The target fits far better as its mirror image. Mirror it and look again.',
  },
  unknown: {
    icon: 'help',
    word: 'Not found.',
    sentence: 'No answer fits well. Click a ring on the source, then the same place on the target; find landmarks again after a few.',
  },
};
const SETTLED: Told = { icon: 'check', word: 'Chosen by you.', sentence: 'The other answers can still be taken.' };

/** The button that begins a search; while a search goes on, its progress and a button that ends it. */
export function FindLandmarks({ state, actions }: Props): VNode {
  const { matching } = state;
  if (matching?.kind === 'searching') {
    return (
      <div class="searching">
        <progress max={1} value={matching.share} aria-label="Looking for landmarks" />
        <button
          type="button"
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
      title="Find pairs at the ends of limbs by the shapes of both meshes; whole pairs that are there stay"
      disabled={!canSearch(state)}
      onClick={actions.findLandmarks}
    >
      <Icon name="target" />
      Find landmarks
    </button>
  );
}

/** The name of a place: its pin where it has one, else its vertex. */
function placeName({ pairs }: State, side: Side, vertex: number): string {
  const pair = pairs.find(({ points }) => points[side] === vertex);
  return pair === undefined ? `vertex ${vertex}` : `pin ${pair.number}`;
}

/** The question that settles a doubt: which of two places on the target belongs to a place on the source. */
function Asked({ report, question, state, actions }: { readonly report: MatchReport; readonly question: Question } & Props): VNode {
  const { source, targets } = question;
  const place = placeName(state, 0, source);
  return (
    <div class="question" role="group" aria-label="Which place is right?">
      <p>
        Where on the {meshName(state, 1)} does {place} of the {meshName(state, 0)} belong?
      </p>
      {([0, 1] as const).map((answer) => {
        const target = targets[answer];
        const name = placeName(state, 1, target);
        return (
          <div class="answer" key={answer}>
            <span>
              At {name}
              {state.pairs.some(({ points }) => points[0] === source && points[1] === target) && ', as now'}
            </span>
            <button
              type="button"
              class="bare"
              aria-label={`Show ${name}`}
              title="Turn both views to the place and its partner"
              onClick={() => {
                actions.lookAtPlaces([source, target]);
              }}
            >
              Show
            </button>
            <button
              type="button"
              aria-label={`This one: ${name}`}
              onClick={() => {
                actions.dispatch(...answered(report, question, answer));
              }}
            >
              This one
            </button>
          </div>
        );
      })}
    </div>
  );
}

/** The other answers of the search, the best first. */
function Alternatives({ found, state, actions }: { readonly found: Found } & Props): VNode | null {
  const answers = listed(found.report)
    .slice(0, LISTED + 1)
    .map((answer) => ({ ...answer, picture: found.pictures[answer.number] }));
  const taken = takenCandidate(state);
  if (answers.length < 2) {
    return null;
  }
  return (
    <Fold title={count(answers.length - 1, 'other answer')}>
      <ol class="answers">
        {answers.map(({ candidate: { score, difference }, number, picture }) => (
          <li key={number}>
            <button
              type="button"
              class="bare"
              aria-pressed={taken === number}
              onClick={() => {
                actions.dispatch({ kind: 'candidate-taken', candidate: number });
              }}
            >
              {picture !== undefined && <AnswerPicture picture={picture} views={actions.turnedViews} />}
              <span>{difference === null ? 'The best answer.' : difference.sentence}</span>
              <span class="quiet">{score.toFixed(2)}</span>
            </button>
          </li>
        ))}
      </ol>
      <p class="quiet small">
        Both meshes in small: what belongs together has one colour. The number says how badly an answer fits: the smaller the better.
      </p>
    </Fold>
  );
}

function toldOf(state: State, { report, isSettled }: Found): Told {
  return isSettled && takenCandidate(state) !== null ? SETTLED : VERDICTS[report.verdict.kind];
}

/** The answer of the search, and how sure it is; `null` before a search. */
export function Matched({ state, actions }: Props): VNode | null {
  const { matching } = state;
  if (matching?.kind !== 'found') {
    return null;
  }
  const told = toldOf(state, matching);
  const { icon, word, sentence } = told;
  const { report } = matching;
  const { question } = report.verdict;
  return (
    <section class="matched" aria-label="Landmarks that were found">
      <div class={`told of-${icon}`} role="status">
        <Icon name={icon} />
        <p>
          <strong>{word}</strong> {sentence}
        </p>
        <button
          type="button"
          class="square"
          aria-label="Hide what was found"
          title="Hide"
          onClick={() => {
            actions.dispatch({ kind: 'search-closed' });
          }}
        >
          <Icon name="close" />
        </button>
      </div>
      {report.verdict.kind === 'mirrored' && told !== SETTLED && (
        <button type="button" onClick={actions.mirrorTarget}>
          Mirror the target
        </button>
      )}
      {question !== null && told !== SETTLED && <Asked report={report} question={question} state={state} actions={actions} />}
      <Alternatives found={matching} state={state} actions={actions} />
    </section>
  );
}

/** The note that the map is made from landmarks that may be wrong. */
export function DoubtfulLandmarks({ state, actions }: Props): VNode | null {
  return isDoubtful(state) ? (
    <div class="note">
      <Icon name="doubt" />
      <div>
        <p>The landmarks were found by the program and are doubtful.</p>
        <button
          type="button"
          onClick={() => {
            actions.dispatch({ kind: 'ui', ui: { step: 'landmarks' } });
          }}
        >
          Answer the question
        </button>
      </div>
    </div>
  ) : null;
}
