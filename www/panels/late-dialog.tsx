/** A dialog over the page whose content is fetched when it is first opened. */
import type { ComponentType, VNode } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import { IconButton } from './controls.tsx';

interface LateDialogProps<P extends object> {
  /** Of the dialog's element. */
  readonly id: string;
  readonly title: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
  readonly load: () => Promise<ComponentType<P>>;
  /** What the content is given. */
  readonly given: P;
}

type Content<P extends object> =
  | { readonly kind: 'waiting' }
  | { readonly kind: 'failed' }
  | { readonly kind: 'there'; readonly Component: ComponentType<P> };

/** The dialog; nothing of its content is drawn while it is closed. */
export function LateDialog<P extends object>({ id, title, isOpen, onClose, load, given }: LateDialogProps<P>): VNode {
  const dialog = useRef<HTMLDialogElement>(null);
  const [content, setContent] = useState<Content<P>>({ kind: 'waiting' });
  const bring = (): void => {
    setContent({ kind: 'waiting' });
    load().then(
      (Component) => {
        setContent({ kind: 'there', Component });
      },
      (thrown: unknown) => {
        console.warn(thrown);
        setContent({ kind: 'failed' });
      },
    );
  };
  // Before the content's own effects, which bring the keyboard to where one begins to read.
  useLayoutEffect(() => {
    if (isOpen) {
      dialog.current?.showModal();
      if (content.kind !== 'there') {
        bring();
      }
    } else {
      dialog.current?.close();
    }
  }, [isOpen]);
  return (
    <dialog
      ref={dialog}
      id={id}
      class="late"
      aria-labelledby={`${id}-title`}
      onClose={onClose}
      onClick={(event) => {
        if (event.target === dialog.current) {
          onClose();
        }
      }}
    >
      <header>
        <h2 id={`${id}-title`}>{title}</h2>
        <IconButton icon="close" label={`Close: ${title}`} onClick={onClose} />
      </header>
      {isOpen && (
        <div class="inside">
          {content.kind === 'waiting' && <p role="status">Loading…</p>}
          {content.kind === 'failed' && (
            <div role="alert">
              <p>This part of the page could not be fetched. Is the network there?</p>
              <button type="button" onClick={bring}>
                Try again
              </button>
            </div>
          )}
          {content.kind === 'there' && <content.Component {...given} />}
        </div>
      )}
    </dialog>
  );
}
