/** The dialog that shows the plots of the last map over the page. */
import type { VNode } from 'preact';
import { useMemo } from 'preact/hooks';
import { lateModule } from '../late-module.ts';
import type { PlotsProps } from '../plots/plots.tsx';
import { earlierOf } from '../store/comparison.ts';
import type { PartProps } from './actions.ts';
import { Icon } from './icons.tsx';
import { LateDialog } from './late-dialog.tsx';

const loadPlots = lateModule(() => import('../plots/plots.tsx'));

/** The button that opens the plots. */
export function PlotsButton({ shell }: Pick<PartProps, 'shell'>): VNode {
  return (
    <button
      type="button"
      class="opens-plots"
      onClick={() => {
        shell.set({ dialog: { kind: 'plots' } });
      }}
    >
      <Icon name="plot" />
      Plots…
    </button>
  );
}

/** The dialog. */
export function PlotsDialog({ state, shell }: PartProps): VNode {
  const { result, earlier } = state;
  const map = useMemo(() => (result === null ? null : earlierOf(result)), [result]);
  const given: PlotsProps = { map, before: earlier, theme: state.ui.theme };
  return (
    <LateDialog
      id="plots"
      title="Plots"
      isOpen={shell.state.dialog?.kind === 'plots'}
      onClose={() => {
        if (shell.state.dialog?.kind === 'plots') {
          shell.set({ dialog: null });
        }
      }}
      load={loadPlots}
      given={given}
    />
  );
}
