/** Toasts: sentences that disappear by themselves, and the offer to continue earlier work. */
import type { VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { offerSentence } from '../messages.ts';
import type { Offer, Toast } from '../store/state.ts';
import { workName } from '../store/work.ts';
import type { Actions, PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';

/** How long a toast stays, in ms: long enough to read two lines and to reach its button. */
const STAYS = 8000;

function ToastBox({ toast, actions }: { readonly toast: Toast; readonly actions: Actions }): VNode {
  // A toast stays while the mouse is over it or the keyboard focus is in it.
  const [held, setHeld] = useState(false);
  useEffect(() => {
    if (held) {
      return undefined;
    }
    const timer = setTimeout(() => {
      actions.dispatch({ kind: 'toast-closed' });
    }, STAYS);
    return () => {
      clearTimeout(timer);
    };
  }, [toast, held]);
  const hold = (): void => {
    setHeld(true);
  };
  const release = (): void => {
    setHeld(false);
  };
  return (
    <div class="toast" id="toast" onMouseEnter={hold} onMouseLeave={release} onFocusIn={hold} onFocusOut={release}>
      <p>{toast.sentence}</p>
      {toast.undo && (
        <button
          type="button"
          onClick={() => {
            actions.dispatch({ kind: 'undo' });
          }}
        >
          Undo
        </button>
      )}
      <IconButton
        icon="close"
        label="Close the note"
        onClick={() => {
          actions.dispatch({ kind: 'toast-closed' });
        }}
      />
    </div>
  );
}

function OfferBox({ offer, actions }: { readonly offer: Offer; readonly actions: Actions }): VNode {
  return (
    <div class="toast" id="offer">
      <p>{offerSentence(workName(offer.names), offer.pairs)}</p>
      <button type="button" onClick={actions.continueWork}>
        Continue
      </button>
      <button type="button" onClick={actions.startAnew}>
        Start anew
      </button>
    </div>
  );
}

/** The toasts over the views. Their element always stays in the page, so that screen readers read out what appears in it. */
export function Toasts({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div class="toasts" role="status">
      {state.offer !== null && <OfferBox offer={state.offer} actions={actions} />}
      {state.toast !== null && <ToastBox toast={state.toast} actions={actions} />}
    </div>
  );
}
