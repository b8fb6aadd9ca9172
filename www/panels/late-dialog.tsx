/** A dialog over the page whose content is fetched when it is first opened. */
import type { ComponentType, VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { Dialog } from './dialog.tsx';

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
  useEffect(() => {
    if (isOpen && content.kind !== 'there') {
      bring();
    }
  }, [isOpen]);
  return (
    <Dialog id={id} kind="late" title={title} closing={`Close: ${title}`} isOpen={isOpen} onClose={onClose}>
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
    </Dialog>
  );
}
