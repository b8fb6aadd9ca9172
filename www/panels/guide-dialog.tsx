/** The dialog that shows the guide over the page. */
import type { VNode } from 'preact';
import type { GuideProps } from '../guide/guide.tsx';
import { lateModule } from '../late-module.ts';
import { shownResult } from '../store/staleness.ts';
import type { PartProps } from './actions.ts';
import { LateDialog } from './late-dialog.tsx';

const BEGINNING = { section: '' };
const loadGuide = lateModule(() => import('../guide/guide.tsx'));

/** The dialog. */
export function GuideDialog({ state, actions, shell }: PartProps): VNode {
  const { dialog } = shell.state;
  const isOpen = dialog?.kind === 'guide';
  const close = (): void => {
    if (shell.state.dialog?.kind === 'guide') {
      shell.set({ dialog: null });
    }
  };
  const given: GuideProps = {
    report: shownResult(state)?.report ?? null,
    wish: isOpen ? dialog : BEGINNING,
    show: (style) => {
      close();
      actions.dispatch({ kind: 'style', style });
    },
  };
  return (
    <LateDialog
      id="guide"
      title="Guide"
      isOpen={isOpen}
      onClose={close}
      load={loadGuide}
      given={given}
    />
  );
}
