/** The only way to change the state: events make a step, and the step is recorded, so that it can be undone. */
import { withLookedAt } from './compared.ts';
import type { Event } from './events.ts';
import { withOwnFlows } from './flat.ts';
import { recorded } from './history.ts';
import { update } from './reducer.ts';
import { inLine } from './settle.ts';
import type { State } from './state.ts';
import { stepName, toastOf } from './steps.ts';
import { isSameWork, workOf } from './work.ts';

/** Events that move in the history or replace it, and so make no step. */
const MOVES: readonly Event['kind'][] = ['undo', 'redo', 'history-begun', 'restored', 'received'];

/** The state after these events, none of which moves in the history, as one step. */
function stepped(before: State, events: readonly Event[]): State {
  const after = events.reduce(update, before);
  if (isSameWork(before, after)) {
    return after;
  }
  const last = events.at(-1);
  const gesture = last?.kind === 'point-moved' ? last.gesture : null;
  const step = { name: stepName(events, before, after), work: workOf(before) };
  const history = recorded(before.history, step, workOf(after), gesture);
  // A toast offers to undo the step that it is about, so it is removed when a later step comes.
  const isLater = after.toast === before.toast;
  return inLine({ ...after, history, toast: toastOf(events, before, after) ?? (isLater ? null : after.toast) }, before);
}

/** The state after events that were dispatched together; they are one step. */
export function change(state: State, events: readonly Event[]): State {
  const at = events.findIndex(({ kind }) => MOVES.includes(kind));
  const move = events[at];
  if (move === undefined) {
    return withOwnFlows(withLookedAt(stepped(state, events)));
  }
  const before = stepped(state, events.slice(0, at));
  const after = update(before, move);
  const settled = isSameWork(before, after) ? after : inLine(after, before);
  return change(settled, events.slice(at + 1));
}
