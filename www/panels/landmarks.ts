/** The list of landmark pairs. */
import { byId, button, download, make } from '../dom.ts';
import type { Pair } from '../landmarks.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';
import { missingSide } from '../store/waiting.ts';
import type { Actions, Panel } from './panel.ts';
import { SuggestionsBlock } from './suggestions.ts';

/** Brings a pair's row into sight and its label under the cursor. */
export function lookAtPair(id: number): void {
  const row = byId('landmark-list').querySelector(`[data-pair="${id}"]`);
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
  }, { title: 'Take the last step back (Ctrl+Z)' });
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
    const target = event.target instanceof Element ? event.target.closest('button[data-id]') : null;
    if (target instanceof HTMLButtonElement) {
      const index = [...list.querySelectorAll('button')].indexOf(target);
      actions.dispatch({ kind: 'pair-deleted', id: Number(target.dataset['id']) });
      const buttons = list.querySelectorAll('button');
      (buttons[Math.min(index, buttons.length - 1)] ?? undo).focus();
    }
  });
  list.addEventListener('change', (event) => {
    const target = event.target;
    if (target instanceof HTMLInputElement) {
      actions.dispatch({ kind: 'pair-labelled', id: Number(target.dataset['id']), label: target.value.trim() });
    }
  });

  function item(pair: Pair): HTMLLIElement {
    const { id, number, label } = pair;
    const missing = missingSide(pair);
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' }, String(number));
    swatch.style.backgroundColor = `color(srgb-linear ${[...colourOf(number - 1)].join(' ')})`;
    if (missing !== null) {
      const sentence = missing === 1 ? 'target is missing' : 'source is missing';
      return make('li', { class: 'pending' }, swatch, make('span', { class: 'quiet' }, sentence));
    }
    const input = make('input', {
      type: 'text',
      value: label,
      placeholder: `Pair ${number}`,
      'aria-label': `Label of pair ${number}`,
      'data-id': id,
    });
    const remove = make(
      'button',
      { type: 'button', class: 'icon', 'data-id': id, 'aria-label': `Delete pair ${number}` },
      '×',
    );
    return make('li', { 'data-pair': id }, swatch, input, remove);
  }

  return {
    render(state: State, previous: State | null): void {
      latest = state;
      suggestions.render(state, previous);
      const running = state.job.kind === 'running';
      const step = state.history.past.at(-1);
      undo.title = step === undefined ? 'Nothing to take back' : `${step.name}: take it back (Ctrl+Z)`;
      undo.disabled = running || state.history.past.length === 0;
      clear.disabled = running || state.pairs.length === 0;
      save.disabled = wholePairs(state).length === 0;
      if (previous?.pairs !== state.pairs) {
        const rows = state.pairs.map(item);
        const grew = previous !== null && state.pairs.length === previous.pairs.length + 1;
        const kept = list.scrollTop;
        list.replaceChildren(...rows);
        list.scrollTop = grew ? list.scrollHeight : kept;
        count.textContent = rows.length === 0 ? '' : String(rows.length);
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
