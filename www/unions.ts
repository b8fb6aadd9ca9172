/** Lists of all words of a union type, whether the core declares it or the page. */

/** The words of a union type, in the order of the record. A record that lacks one of the words, or has another one, does not compile. */
export function wordsOf<T extends string>(words: Readonly<Record<T, unknown>>): readonly T[] {
  return Object.keys(words) as T[];
}
