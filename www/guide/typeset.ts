/** Equations as MathML, which the browser itself draws: no style sheet, no font and no inline style comes with it. */
import katex from 'katex';

/** The markup of a displayed equation. Throws where it is not TeX. */
export function typeset(tex: string): string {
  return katex.renderToString(tex, { output: 'mathml', displayMode: true, throwOnError: true, strict: 'error', trust: false });
}
