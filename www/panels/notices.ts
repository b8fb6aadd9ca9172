/** What the page says beside errors: a step that can be taken back, and work of an earlier visit. */
import { byId, button, make } from '../dom.ts';
import { offerSentence } from '../messages.ts';
import type { State } from '../store/state.ts';
import { workName } from '../store/work.ts';
import type { Actions, Panel } from './panel.ts';

/** How long a toast stays, in ms: to read two lines and come to its button. */
const STAYS = 8000;

/** Makes both boxes above the panels. */
export function notices(actions: Actions): Panel {
  const toastText = make('p');
  const undo = button('Undo', () => {
    actions.dispatch({ kind: 'undo' });
  });
  const close = button('×', () => {
    actions.dispatch({ kind: 'toast-closed' });
  }, { class: 'icon', 'aria-label': 'Close the note' });
  const toast = make('div', { id: 'toast', class: 'card', role: 'status', hidden: true }, toastText, make('div', { class: 'row' }, undo, close));
  const offerText = make('p');
  const offer = make(
    'div',
    { id: 'offer', class: 'card', role: 'status', hidden: true },
    offerText,
    make('div', { class: 'row' }, button('Continue', actions.continueWork, { class: 'primary' }), button('Start anew', actions.startAnew)),
  );
  byId('side').prepend(offer, toast);
  let timer: ReturnType<typeof setTimeout> | undefined;
  return {
    render(state: State, previous: State | null): void {
      if (previous?.toast !== state.toast) {
        clearTimeout(timer);
        toast.hidden = state.toast === null;
        toastText.textContent = state.toast?.sentence ?? '';
        undo.hidden = state.toast?.undo !== true;
        if (state.toast !== null) {
          timer = setTimeout(() => {
            actions.dispatch({ kind: 'toast-closed' });
          }, STAYS);
        }
      }
      offer.hidden = state.offer === null;
      if (state.offer !== null) {
        offerText.textContent = offerSentence(workName(state.offer.names), state.offer.pairs);
      }
    },
  };
}
