/** A dialog that covers the page while it is open. */
import type { ComponentChildren, VNode } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';
import { IconButton } from './controls.tsx';

interface DialogProps {
  /** The id of the element; the id of its title is this and `-title`. */
  readonly id: string;
  readonly kind: string;
  readonly title: string;
  /** The label of the button that closes the dialog. */
  readonly closing: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
  readonly children: ComponentChildren;
}

/** The dialog; a click beside it closes it. */
export function Dialog({ id, kind, title, closing, isOpen, onClose, children }: DialogProps): VNode {
  const dialog = useRef<HTMLDialogElement>(null);
  // This effect runs before the content's own effects, which may move the keyboard focus into the content.
  useLayoutEffect(() => {
    if (isOpen) {
      dialog.current?.showModal();
    } else {
      dialog.current?.close();
    }
  }, [isOpen]);
  return (
    <dialog
      ref={dialog}
      id={id}
      class={kind}
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
        <IconButton icon="close" label={closing} onClick={onClose} />
      </header>
      {children}
    </dialog>
  );
}
