/** Asks the map for the partner of a half pair, so that it need only be accepted. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import { otherSide } from '../landmarks.ts';
import type { Event } from '../store/events.ts';
import type { Question } from '../store/proposal.ts';
import { isSameQuestion, questionOf } from '../store/proposal.ts';
import type { Proposal } from '../store/state.ts';
import type { Store } from '../store/store.ts';

/** What knows the map, and shows what it proposes. */
export interface Proposer {
  /** Where the map takes a point of a side on the other one; `null` where it tells no place for a landmark. */
  imageOf(side: Side, point: SurfacePoint): SurfacePoint | null;
  bringIntoSight(proposal: Proposal): void;
}

/** Answers a question, if it is still asked; whoever asks about another pair is shown where the answer is. */
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
    // Its place is seen in the source's own shape.
    events.push({ kind: 'style', style: { morph: 0 } });
  }
  store.dispatch(...events);
  if (before?.id !== id) {
    proposer.bringIntoSight(proposal);
  }
}

/** From now on every half pair whose turn it is has the map's proposal, where there is a map. */
export function listenForHalves(store: Store, proposer: Proposer): void {
  store.subscribe((state, previous) => {
    const [question, before] = [questionOf(state), questionOf(previous)];
    if (question !== null && !isSameQuestion(question, before)) {
      // The next change, not one within this.
      queueMicrotask(() => {
        answer(store, proposer, question, before);
      });
    }
  });
}
