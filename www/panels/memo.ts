/** Components that are drawn again only when one of their properties has changed. */
import type { ComponentChildren, FunctionComponent } from 'preact';
import { Component, h } from 'preact';

function differ(a: object, b: object): boolean {
  const [before, after] = [Object.entries(a), new Map<string, unknown>(Object.entries(b))];
  return before.length !== after.size || before.some(([key, value]) => after.get(key) !== value);
}

/** A component that is not drawn again while its properties are the same objects. */
export function memo<P extends object>(component: FunctionComponent<P>): new () => Component<P> {
  return class extends Component<P> {
    override shouldComponentUpdate(next: Readonly<P>): boolean {
      return differ(this.props, next);
    }

    override render(): ComponentChildren {
      return h(component, this.props);
    }
  };
}
