/** The banner over the views that says what went wrong. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import { copied } from '../dom.ts';
import { breakdownReport, toldBreakdown } from '../store/breakdown.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';

/** Copies the report of a breakdown; where the browser forbids that, the report is shown to be copied by hand. */
function ReportButton({ state }: { readonly state: State }): VNode | null {
  const [shown, setShown] = useState<{ readonly report: string; readonly isCopied: boolean } | null>(null);
  const breakdown = toldBreakdown(state);
  if (breakdown === null) {
    return null;
  }
  const report = breakdownReport(state, breakdown, { address: location.href, browser: navigator.userAgent });
  const told = shown?.report === report ? shown : null;
  return (
    <>
      <button
        type="button"
        id="copy-report"
        title="Sizes, options and what broke off; nothing of your files"
        onClick={() => {
          void copied(report).then((isCopied) => {
            setShown({ report, isCopied });
          });
        }}
      >
        {told?.isCopied === true ? 'Copied' : 'Copy a report'}
      </button>
      {told?.isCopied === false && <textarea readOnly rows={6} aria-label="Report" value={report} />}
    </>
  );
}

/** The banner. Its element always stays in the page, so that screen readers read out what appears in it. */
export function ErrorBanner({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  return (
    <div id="error" role="alert" hidden={state.error === null}>
      <div>
        <p>{state.error}</p>
        <ReportButton state={state} />
      </div>
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
