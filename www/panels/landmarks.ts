/** The list of landmark pairs. */
import { byId, button, download, make } from '../dom.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import type { State } from '../store/state.ts';
import type { Actions, Panel } from './panel.ts';
import { SuggestionsBlock } from './suggestions.ts';

/** Brings a pair's row into sight and its label under the cursor. */
export function lookAtPair(index: number): void {
  const row = byId('landmark-list').querySelector(`[data-pair="${index}"]`);
  row?.scrollIntoView({ block: 'center' });
  row?.querySelector('input')?.focus();
}

/** Makes the panel; `colourOf` gives the colour of a landmark's marker, linear RGB from 0 to 1. */
export function landmarksPanel(actions: Actions, colourOf: (index: number) => Iterable<number>): Panel {
  const root = byId('landmarks');
  const count = make('span', { class: 'count' });
  const list = make('ol', { id: 'landmark-list' });
  const empty = make('p', { class: 'quiet' }, 'No landmarks yet.');
  let latest: State | null = null;
  const undo = button('Undo', () => {
    actions.dispatch({ kind: 'undo' });
  }, { title: 'Undo the last change of the landmarks (Ctrl+Z)' });
  const clear = button('Clear all', () => {
    actions.dispatch({ kind: 'pairs-cleared' });
  });
  const save = button('Save file', () => {
    if (latest !== null) {
      const text = JSON.stringify(landmarkFileOf(latest), null, 1);
      download('landmarks.json', 'application/json', text);
    }
  }, { id: 'save-landmarks' });
  const suggestions = new SuggestionsBlock(actions);
  root.append(
    make('h2', {}, 'Landmarks ', count),
    make('div', { class: 'row' }, undo, clear, save),
    suggestions.root,
    empty,
    list,
  );
  list.addEventListener('click', (event) => {
    const target = event.target instanceof Element ? event.target.closest('button[data-index]') : null;
    if (target instanceof HTMLButtonElement) {
      const index = Number(target.dataset['index']);
      actions.dispatch({ kind: 'pair-deleted', index });
      const buttons = list.querySelectorAll('button');
      (buttons[Math.min(index, buttons.length - 1)] ?? undo).focus();
    }
  });
  list.addEventListener('change', (event) => {
    const target = event.target;
    if (target instanceof HTMLInputElement) {
      actions.dispatch({ kind: 'pair-labelled', index: Number(target.dataset['index']), label: target.value.trim() });
    }
  });

  function item(index: number, label: string, pending: boolean): HTMLLIElement {
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' }, String(index + 1));
    swatch.style.backgroundColor = `color(srgb-linear ${[...colourOf(index)].join(' ')})`;
    if (pending) {
      return make('li', { class: 'pending' }, swatch, make('span', { class: 'quiet' }, label));
    }
    const input = make('input', {
      type: 'text',
      value: label,
      placeholder: `Pair ${index + 1}`,
      'aria-label': `Label of pair ${index + 1}`,
      'data-index': index,
    });
    const remove = make(
      'button',
      { type: 'button', class: 'icon', 'data-index': index, 'aria-label': `Delete pair ${index + 1}` },
      '×',
    );
    return make('li', { 'data-pair': index }, swatch, input, remove);
  }

  return {
    render(state: State, previous: State | null): void {
      latest = state;
      suggestions.render(state, previous);
      const running = state.job.kind === 'running';
      undo.disabled = running || (state.history.length === 0 && state.pending === null);
      clear.disabled = running || (state.pairs.length === 0 && state.pending === null);
      save.disabled = state.pairs.length === 0;
      if (previous?.pairs !== state.pairs || previous.pending !== state.pending) {
        const rows = state.pairs.map((pair, index) => item(index, pair.label, false));
        if (state.pending !== null) {
          rows.push(item(state.pairs.length, state.pending.side === 0 ? 'target is missing' : 'source is missing', true));
        }
        const grew = previous !== null && state.pairs.length === previous.pairs.length + 1;
        const kept = list.scrollTop;
        list.replaceChildren(...rows);
        list.scrollTop = grew || state.pending !== null ? list.scrollHeight : kept;
        count.textContent = state.pairs.length === 0 ? '' : String(state.pairs.length);
        empty.hidden = rows.length > 0;
      }
      if (previous?.job.kind !== state.job.kind) {
        root.classList.toggle('locked', running);
        for (const element of list.querySelectorAll('button, input')) {
          element.toggleAttribute('disabled', running);
        }
      }
    },
  };
}
