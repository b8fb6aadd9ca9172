/** What went wrong, in one sentence over the views. */
import type { VNode } from 'preact';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';

/** The banner; it stays in the page, so that what comes into it is read out. */
export function ErrorBanner({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div id="error" role="alert" hidden={state.error === null}>
      <p>{state.error}</p>
      <IconButton
        icon="close"
        label="Close the message"
        onClick={() => {
          actions.dispatch({ kind: 'error-closed' });
        }}
      />
    </div>
  );
}
