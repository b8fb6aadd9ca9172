/**
 * An equation of the guide. The module that typesets it is fetched with the first equation; until it has come, and where it fails, the
 * equation is plain text.
 */
import type { VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { lateModule } from '../late-module.ts';

const loadTypeset = lateModule(() => import('./typeset.ts'));

export interface Formula {
  readonly tex: string;
  /** The equation as a line of text. */
  readonly plain: string;
}

export function Equation({ tex, plain }: Formula): VNode {
  const [markup, setMarkup] = useState<string | null>(null);
  useEffect(() => {
    let isShown = true;
    loadTypeset().then(
      ({ typeset }) => {
        if (isShown) {
          setMarkup(typeset(tex));
        }
      },
      () => undefined,
    );
    return () => {
      isShown = false;
    };
  }, [tex]);
  return markup === null ? (
    <p class="equation plain">{plain}</p>
  ) : (
    // The markup is made from the guide's own text alone.
    <div class="equation" dangerouslySetInnerHTML={{ __html: markup }} />
  );
}
