/** Equations as MathML, which the browser itself draws: no style sheet, no font and no inline style comes with it. */
import katex from 'katex';

/** The markup of an equation on a line of its own. Throws where it is no TeX. */
export function typeset(tex: string): string {
  return katex.renderToString(tex, { output: 'mathml', displayMode: true, throwOnError: true, strict: 'error', trust: false });
}
