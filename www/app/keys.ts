/** The keys of the whole page; the viewer handles the keys of a view. */
import { isTyped } from '../dom.ts';
import { proposed } from '../store/proposal.ts';
import type { Store } from '../store/store.ts';
import { leaveTask } from './task.ts';

/** The step of the history that a key asks for: Ctrl+Z undoes, Ctrl+Shift+Z and Ctrl+Y redo, on a Mac with Cmd. */
export function moveOf(event: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'shiftKey' | 'altKey'>): 'undo' | 'redo' | null {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) {
    return null;
  }
  switch (event.key.toLowerCase()) {
    case 'z':
      return event.shiftKey ? 'redo' : 'undo';
    case 'y':
      return event.shiftKey ? null : 'redo';
    default:
      return null;
  }
}

/** While no element of the page has the focus, Enter accepts the place that the map proposes, and Escape drops it. */
export function listenForProposal(store: Store): void {
  window.addEventListener('keydown', (event) => {
    if (event.target !== document.body || event.ctrlKey || event.metaKey || event.altKey || proposed(store.state) === null) {
      return;
    }
    if (event.key === 'Enter' || event.key === 'Escape') {
      event.preventDefault();
      store.dispatch({ kind: event.key === 'Enter' ? 'proposal-accepted' : 'proposal-dropped' });
    }
  });
}

/**
 * Escape leaves the task that the page is busy with, or else ends the comparison with another map. It does neither where the key belongs to
 * a text field, a dialog or a view.
 */
export function listenForLeaving(store: Store): void {
  window.addEventListener('keydown', (event) => {
    const isTaken = event.defaultPrevented || isTyped(event.target) || (event.target instanceof Element && event.target.closest('dialog') !== null);
    if (event.key !== 'Escape' || isTaken) {
      return;
    }
    if (store.state.job.kind === 'busy') {
      leaveTask(store);
    } else {
      store.dispatch({ kind: 'comparison-closed' });
    }
  });
}

/** The keys of the history step through the work; in a text field they step through what was typed there. */
export function listenForUndo(store: Store): void {
  window.addEventListener('keydown', (event) => {
    const kind = moveOf(event);
    if (kind !== null && !isTyped(event.target) && store.state.job.kind !== 'running') {
      event.preventDefault();
      store.dispatch({ kind });
    }
  });
}
