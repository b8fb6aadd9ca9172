/** A dialog over the page whose content is fetched when it is first opened. */
import type { ComponentType, VNode } from 'preact';
import { Dialog } from './dialog.tsx';
import { Late } from './late.tsx';

interface LateDialogProps<P extends object> {
  /** The id of the dialog's element. */
  readonly id: string;
  readonly title: string;
  readonly isOpen: boolean;
  readonly onClose: () => void;
  readonly load: () => Promise<{ readonly default: ComponentType<P> }>;
  /** The properties of the content. */
  readonly given: P;
}

/** The dialog; its content is not drawn while it is closed. */
export function LateDialog<P extends object>({ id, title, isOpen, onClose, load, given }: LateDialogProps<P>): VNode {
  return (
    <Dialog id={id} kind="late" title={title} closing={`Close: ${title}`} isOpen={isOpen} onClose={onClose}>
      {/* This element stays while the dialog is closed, so that the content is fetched only once. */}
      <div class="inside" hidden={!isOpen}>
        <Late isWanted={isOpen} load={load} given={given} />
      </div>
    </Dialog>
  );
}
