/** Lists of all the words of a union that the core declares, or a type of the page. */

/** The words of a union, in the order in which they are told. A record that lacks one of them, or has another, does not compile. */
export function wordsOf<T extends string>(words: Readonly<Record<T, unknown>>): readonly T[] {
  return Object.keys(words) as T[];
}
