/** Brings work onto the page that was kept, or sent. */
import type { Pair } from '../landmarks.ts';
import type { History, Step } from './history.ts';
import { NO_HISTORY, recorded } from './history.ts';
import type { State, Ui } from './state.ts';
import type { Work } from './work.ts';
import { workName, workOf } from './work.ts';

/** The work and its steps, with the ids of the pairs increased above those of this page; lists that steps share stay shared. */
function raised(work: Work, history: History, by: number): { readonly work: Work; readonly history: History } {
  const known = new Map<readonly Pair[], readonly Pair[]>();
  const above = (before: Work): Work => {
    const pairs = known.get(before.pairs) ?? before.pairs.map((pair) => ({ ...pair, id: pair.id + by }));
    known.set(before.pairs, pairs);
    return { ...before, pairs };
  };
  const steps = (list: readonly Step[]): Step[] => list.map(({ name, work: of }) => ({ name, work: above(of) }));
  return { work: above(work), history: { past: steps(history.past), future: steps(history.future), gesture: null } };
}

function highestId(work: Work, { past, future }: History): number {
  const works = [work, ...past.map((step) => step.work), ...future.map((step) => step.work)];
  return Math.max(0, ...works.map(({ pairs }) => pairs.reduce((most, { id }) => Math.max(most, id), 0)));
}

function nameOf(work: Work): string {
  return workName(work.meshes.map((file) => file?.name ?? null));
}

/** Whether nothing was done on the page. */
function isFresh({ history: { past, future } }: State): boolean {
  return past.length + future.length === 0;
}

/** The state with work that replaces its own as one step of this name; `history` has the work's own steps. */
function replaced(state: State, { work, history }: ReturnType<typeof raised>, ui: Partial<Ui>, name: string): State {
  return {
    ...state,
    ...work,
    ui: { ...state.ui, ...ui },
    history: recorded(state.history, { name, work: workOf(state) }, work, null),
    nextId: Math.max(state.nextId, highestId(work, history) + 1),
    error: null,
  };
}

/** The state with work that was sent, as one step that can be undone. */
export function withReceived(state: State, sent: Work, ui: Partial<Ui>): State {
  const toast = isFresh(state) ? null : { sentence: `Opened ${nameOf(sent)}.`, undo: true };
  return { ...replaced(state, raised(sent, NO_HISTORY, state.nextId - 1), ui, `Open ${nameOf(sent)}`), toast };
}

/** The state with kept work: with its own steps where nothing was done on the page, else as one step that can be undone. */
export function withRestored(state: State, kept: { readonly work: Work; readonly history: History }, ui: Partial<Ui>): State {
  const own = raised(kept.work, kept.history, state.nextId - 1);
  const name = nameOf(kept.work);
  const back = replaced(state, own, ui, `Continue with ${name}`);
  return isFresh(state) ? { ...back, history: own.history, toast: null } : { ...back, toast: { sentence: `Continued with ${name}.`, undo: true } };
}
