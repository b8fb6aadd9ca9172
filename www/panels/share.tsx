/** The box of the Share button: the link to what is on the page, what its receiver will see, and the project file. */
import type { VNode } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { copied } from '../dom.ts';
import { prospectSentence, SENTENCES } from '../messages.ts';
import type { State } from '../store/state.ts';
import type { Actions } from './actions.ts';

type Shared = Awaited<ReturnType<Actions['sharedLink']>>;

interface LinkBoxProps {
  readonly shared: NonNullable<Shared>;
}

/** The link, to be copied by hand or by a button. */
function LinkBox({ shared }: LinkBoxProps): VNode {
  const [onClipboard, setOnClipboard] = useState('');
  const field = useRef<HTMLInputElement>(null);
  const copy = (): void => {
    // Where the browser forbids copying, the link stays selected for the user.
    field.current?.select();
    void copied(shared.url).then((isCopied) => {
      if (isCopied) {
        setOnClipboard(shared.url);
      }
    });
  };
  return (
    <>
      <p>{prospectSentence(shared.prospect)}</p>
      <input
        ref={field}
        id="link"
        type="text"
        readOnly
        aria-label="Link"
        value={shared.url}
        onFocus={(event) => {
          event.currentTarget.select();
        }}
      />
      <button type="button" id="copy-link" class="main" onClick={copy}>
        {onClipboard === shared.url ? 'Copied' : 'Copy link'}
      </button>
      <span role="status" class="unseen">
        {onClipboard === shared.url ? 'The link is copied.' : ''}
      </span>
    </>
  );
}

/** The box. */
export function Share({ state, actions }: { readonly state: State; readonly actions: Actions }): VNode {
  const [shared, setShared] = useState<Shared | undefined>(undefined);
  const isEmpty = state.meshes.every((file) => file === null);
  useEffect(() => {
    let isLatest = true;
    void actions.sharedLink().then((link) => {
      if (isLatest) {
        setShared(link);
      }
    });
    return () => {
      isLatest = false;
    };
  }, [state.meshes, state.pairs, state.options, state.up, state.ui.cameras, state.ui.style]);
  if (isEmpty) {
    return <p>{SENTENCES.nothingToShare}</p>;
  }
  return (
    <div class="share">
      {shared === null && <p>{SENTENCES.noLink}</p>}
      {shared !== null && shared !== undefined && <LinkBox shared={shared} />}
      <button type="button" id="save-project" title={SENTENCES.aboutProject} onClick={actions.saveProject}>
        Save project file
      </button>
    </div>
  );
}
