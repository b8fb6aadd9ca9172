/** Parts of the page that are fetched when they are first needed. */
import type { ComponentType, VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';

type Content<P extends object> =
  | { readonly kind: 'waiting' }
  | { readonly kind: 'failed' }
  | { readonly kind: 'there'; readonly Component: ComponentType<P> };

/** For each loader, the component that it has loaded: a part that is drawn a second time is there at once. */
const BROUGHT = new WeakMap<object, unknown>();

interface LateProps<P extends object> {
  readonly isWanted: boolean;
  /** Loads the module of the part; the same function at each drawing. */
  readonly load: () => Promise<{ readonly default: ComponentType<P> }>;
  /** The properties of the part. */
  readonly given: P;
}

/** The part, or a sentence about why it is missing; `null` while the part is not wanted. */
export function Late<P extends object>({ isWanted, load, given }: LateProps<P>): VNode | null {
  const [content, setContent] = useState<Content<P>>(() => {
    const known = BROUGHT.get(load) as ComponentType<P> | undefined;
    return known === undefined ? { kind: 'waiting' } : { kind: 'there', Component: known };
  });
  const bring = (): void => {
    setContent({ kind: 'waiting' });
    load().then(
      ({ default: Component }) => {
        BROUGHT.set(load, Component);
        setContent({ kind: 'there', Component });
      },
      (thrown: unknown) => {
        console.warn(thrown);
        setContent({ kind: 'failed' });
      },
    );
  };
  useEffect(() => {
    if (isWanted && content.kind !== 'there') {
      bring();
    }
  }, [isWanted]);
  if (!isWanted) {
    return null;
  }
  switch (content.kind) {
    case 'waiting':
      return <p role="status">Loading…</p>;
    case 'failed':
      return (
        <div role="alert">
          <p>
            This part of the page could not be fetched. Is the network there? Where another try does not help, reload the page: your
            work is kept.
          </p>
          <button type="button" onClick={bring}>
            Try again
          </button>
        </div>
      );
    case 'there':
      return <content.Component {...given} />;
  }
}
