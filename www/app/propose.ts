/** Asks the map where the missing point of a half pair should be, so that the user need only accept that place. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import { otherSide } from '../landmarks.ts';
import type { Event } from '../store/events.ts';
import type { Question } from '../store/proposal.ts';
import { isSameQuestion, questionOf } from '../store/proposal.ts';
import type { Proposal } from '../store/state.ts';
import type { Store } from '../store/store.ts';

/** The views, which know the map and show what it proposes. */
export interface Proposer {
  /** The image of a point of a side on the other side; `null` where the map gives no place for a landmark. */
  imageOf(side: Side, point: SurfacePoint): SurfacePoint | null;
  bringIntoSight(proposal: Proposal): void;
}

/** Answers a question if it is still asked; when the question is about another pair than before, the views turn to the answer. */
function answer(store: Store, proposer: Proposer, question: Question, before: Question | null): void {
  if (!isSameQuestion(questionOf(store.state), question)) {
    return;
  }
  const { id, side, point: of } = question;
  const point = proposer.imageOf(otherSide(side), of);
  if (point === null) {
    return;
  }
  const proposal = { id, of, side, point };
  const events: Event[] = [{ kind: 'proposed', proposal }];
  if (side === 0) {
    // A place on the source can be seen only in the source's own shape.
    events.push({ kind: 'style', style: { morph: 0 } });
  }
  store.dispatch(...events);
  if (before?.id !== id) {
    proposer.bringIntoSight(proposal);
  }
}

/** From now on, where there is a map, each half pair whose turn it is gets the map's proposal. */
export function listenForHalves(store: Store, proposer: Proposer): void {
  store.subscribe((state, previous) => {
    const [question, before] = [questionOf(state), questionOf(previous)];
    if (question !== null && !isSameQuestion(question, before)) {
      // The proposal is a change of its own, after the present one.
      queueMicrotask(() => {
        answer(store, proposer, question, before);
      });
    }
  });
}
