/** Suggested landmarks: asked for by a button, taken one by one or all at once. */
import { button, make } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { suggestionName } from '../messages.ts';
import type { State } from '../store/state.ts';
import type { Actions } from './panel.ts';

const NAMES = ['source', 'target'] as const;

interface Block {
  readonly ask: HTMLButtonElement;
  readonly found: HTMLElement;
}

/** The part of the landmarks panel about suggestions. */
export class SuggestionsBlock {
  readonly root = make('div', { id: 'suggestions' });
  readonly #actions: Actions;
  readonly #blocks: readonly [Block, Block];

  constructor(actions: Actions) {
    this.#actions = actions;
    const block = (side: Side): Block => ({
      ask: button(`On the ${NAMES[side]}`, () => {
        actions.suggest(side);
      }, { id: `suggest-${NAMES[side]}`, title: `Mark places of the ${NAMES[side]} that are worth a landmark`, 'aria-label': `Suggest landmarks on the ${NAMES[side]}` }),
      found: make('div', { class: 'found', role: 'group', 'aria-label': `Suggestions on the ${NAMES[side]}`, hidden: true }),
    });
    this.#blocks = [block(0), block(1)];
    this.root.append(
      make('div', { class: 'row' }, make('span', { class: 'quiet' }, 'Suggest landmarks:'), this.#blocks[0].ask, this.#blocks[1].ask),
      this.#blocks[0].found,
      this.#blocks[1].found,
    );
  }

  render(state: State, previous: State | null): void {
    const running = state.job.kind === 'running';
    for (const side of SIDES) {
      const { ask, found } = this.#blocks[side];
      ask.disabled = running || state.meshes[side] === null;
      if (previous?.suggestions[side] !== state.suggestions[side]) {
        const hadFocus = found.contains(document.activeElement);
        found.hidden = state.suggestions[side].length === 0;
        found.replaceChildren(...this.#rows(state, side));
        if (hadFocus) {
          (found.querySelector('button') ?? ask).focus();
        }
      }
      for (const element of found.querySelectorAll('button')) {
        element.disabled = running;
      }
    }
  }

  #rows(state: State, side: Side): HTMLElement[] {
    const suggestions = state.suggestions[side];
    const other = NAMES[side === 0 ? 1 : 0];
    const items = suggestions.map((suggestion) => {
      const name = suggestionName(suggestion, suggestions);
      const take = button(suggestion.letter, () => {
        this.#actions.dispatch({ kind: 'point-picked', side, point: suggestion.point });
      }, { class: 'ring', title: name, 'aria-label': `Take ${name}` });
      return make('li', {}, take);
    });
    return [
      make('p', { class: 'quiet' }, `Rings on the ${NAMES[side]}: click those that you want, then the same places on the ${other}.`),
      make('ol', {}, ...items),
      make(
        'div',
        { class: 'row' },
        button(`Take all ${suggestions.length}`, () => {
          this.#actions.dispatch({ kind: 'suggestions-taken', side });
        }, { title: `Take all of them, then pick their places on the ${other} one after the other` }),
        button('Hide', () => {
          this.#actions.dispatch({ kind: 'suggested', side, suggestions: [] });
        }),
      ),
    ];
  }
}
