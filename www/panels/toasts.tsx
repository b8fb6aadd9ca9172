/** Sentences that go by themselves, and the offer of earlier work. */
import type { VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { offerSentence } from '../messages.ts';
import type { Offer, Toast } from '../store/state.ts';
import { shortName } from '../store/work.ts';
import type { Actions, PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';

/** How long a toast stays, in ms: to read two lines and to come to its button. */
const STAYS = 8000;

function ToastBox({ toast, actions }: { readonly toast: Toast; readonly actions: Actions }): VNode {
  // Under the mouse or with the keyboard's place it stays.
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
  const names = offer.names.flatMap((name) => (name === null ? [] : [shortName(name)]));
  return (
    <div class="toast" id="offer">
      <p>{offerSentence(names.join(' and '), offer.pairs)}</p>
      <button type="button" onClick={actions.continueWork}>
        Continue
      </button>
      <button type="button" onClick={actions.startAnew}>
        Start anew
      </button>
    </div>
  );
}

/** The toasts over the views; the box stays, so that what comes into it is read out. */
export function Toasts({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div class="toasts" role="status">
      {state.offer !== null && <OfferBox offer={state.offer} actions={actions} />}
      {state.toast !== null && <ToastBox toast={state.toast} actions={actions} />}
    </div>
  );
}
