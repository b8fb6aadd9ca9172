/** Names that tell left from right. */

/** Words for the sides, each with its opposite. */
const OPPOSITES: Readonly<Record<string, string>> = { left: 'right', right: 'left', l: 'r', r: 'l' };

/** Such a word by itself; a letter only at an end of the name, where it is no one's initial. */
const SIDE_WORD = /(?<![\p{L}\p{N}])(?:left|right)(?![\p{L}\p{N}])|^[lr](?=[\s_.-])|(?<=[\s_.-])[lr]$/giu;

/** A word in the letters' case of another one. */
function inCaseOf(word: string, model: string): string {
  if (model === model.toUpperCase()) {
    return word.toUpperCase();
  }
  return /^\p{Lu}/u.test(model) ? word.charAt(0).toUpperCase() + word.slice(1) : word;
}

/** The name of the other side: "left ear" for "right ear"; `null` for a name that tells no side. */
export function otherName(name: string): string | null {
  const other = name.replace(SIDE_WORD, (word) => inCaseOf(OPPOSITES[word.toLowerCase()] ?? word, word));
  return other === name ? null : other;
}
