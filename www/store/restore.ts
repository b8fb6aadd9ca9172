/** Brings kept work back onto the page. */
import type { Pair } from '../landmarks.ts';
import type { History, Step } from './history.ts';
import { recorded } from './history.ts';
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

/** The state with kept work: with its own steps where nothing was done on the page, else as one step that can be undone. */
export function withRestored(state: State, kept: { readonly work: Work; readonly history: History }, ui: Partial<Ui>): State {
  const { work, history } = raised(kept.work, kept.history, state.nextId - 1);
  const { past, future } = state.history;
  const isFresh = past.length + future.length === 0;
  const name = `Continue with ${workName(work.meshes.map((file) => file?.name ?? null))}`;
  return {
    ...state,
    ...work,
    ui: { ...state.ui, ...ui },
    history: isFresh ? history : recorded(state.history, { name, work: workOf(state) }, work, null),
    nextId: Math.max(state.nextId, highestId(work, history) + 1),
    toast: isFresh ? null : { sentence: `${name.replace('Continue', 'Continued')}.`, undo: true },
    error: null,
  };
}
