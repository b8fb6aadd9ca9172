/** Keys of the whole page; those of a view are the viewer's. */
import type { Store } from '../store/store.ts';

/** Ctrl+Z takes back the last change of the landmarks, but in a text field what was typed there. */
export function listenForUndo(store: Store): void {
  window.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type === 'text';
    const undoes = (event.ctrlKey || event.metaKey) && !event.shiftKey && event.key.toLowerCase() === 'z';
    if (undoes && !typing && store.state.job.kind !== 'running') {
      event.preventDefault();
      store.dispatch({ kind: 'undo' });
    }
  });
}
