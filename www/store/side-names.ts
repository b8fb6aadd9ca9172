/** Labels that name a side, left or right. */

/** The words for a side, each with its opposite. */
const OPPOSITES: Readonly<Record<string, string>> = { left: 'right', right: 'left', l: 'r', r: 'l' };

/** Such a word standing by itself; a single letter only at an end of the label, where it is nobody's initial. */
const SIDE_WORD = /(?<![\p{L}\p{N}])(?:left|right)(?![\p{L}\p{N}])|^[lr](?=[\s_.-])|(?<=[\s_.-])[lr]$/giu;

/** A word in the case of another one: upper, capitalised or lower. */
function inCaseOf(word: string, model: string): string {
  if (model === model.toUpperCase()) {
    return word.toUpperCase();
  }
  return /^\p{Lu}/u.test(model) ? word.charAt(0).toUpperCase() + word.slice(1) : word;
}

/** The label for the other side, such as "left ear" for "right ear"; `null` for a label that names no side. */
export function otherName(name: string): string | null {
  const other = name.replace(SIDE_WORD, (word) => inCaseOf(OPPOSITES[word.toLowerCase()] ?? word, word));
  return other === name ? null : other;
}
