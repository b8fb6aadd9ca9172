/** What the Share button opens. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import type { State } from '../store/state.ts';

/** A link to the demo; files of one's own have none. */
export function Share({ state }: { readonly state: State }): VNode {
  const [copied, setCopied] = useState(false);
  if (state.demo === null) {
    return <p>Your meshes stay on this computer: only a demo has a link. Send the files and the landmark file instead.</p>;
  }
  return (
    <>
      <p>The link opens the demo “{state.demo.title}” with its own landmarks.</p>
      <button
        type="button"
        onClick={() => {
          void navigator.clipboard.writeText(location.href).then(() => {
            setCopied(true);
          });
        }}
      >
        {copied ? 'Copied' : 'Copy link'}
      </button>
    </>
  );
}
