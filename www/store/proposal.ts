/** The place that the map proposes for the half pair whose turn it is: the image of its point on the other mesh. */
import type { Side, SurfacePoint } from '../landmarks.ts';
import { isSamePoint, otherSide } from '../landmarks.ts';
import { shownResult } from './staleness.ts';
import type { Proposal, Result, State } from './state.ts';
import { asked } from './waiting.ts';

type Asking = Pick<State, 'pairs' | 'ui' | 'result' | 'meshes' | 'proposal'>;

/** The question to the map: where does it take this point of a half pair? */
export interface Question {
  /** The id of the pair. */
  readonly id: number;
  readonly point: SurfacePoint;
  /** The side of the image. */
  readonly side: Side;
  /** The map that is asked. */
  readonly result: Result;
}

/** The present question; `null` where no half pair waits, or there is no map of these meshes. */
export function questionOf(state: Asking): Question | null {
  const result = shownResult(state);
  const turn = asked(state);
  const point = turn?.pair.points[otherSide(turn.side)] ?? null;
  return result === null || turn === null || point === null ? null : { id: turn.pair.id, point, side: turn.side, result };
}

/** Whether two questions have the same answer. */
export function isSameQuestion(a: Question | null, b: Question | null): boolean {
  return a === null || b === null
    ? a === b
    : a.id === b.id && a.side === b.side && a.result === b.result && isSamePoint(a.point, b.point);
}

/** The place that is proposed now; `null` for none. */
export function proposed(state: Asking): Proposal | null {
  const { proposal } = state;
  const question = proposal === null ? null : questionOf(state);
  const isIts = question?.id === proposal?.id && question?.side === proposal?.side;
  return isIts && isSamePoint(question?.point ?? null, proposal?.of ?? null) ? proposal : null;
}
