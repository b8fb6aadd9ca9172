/** Random numbers from a seed, so that a test that fails will fail again. */

/** Marsaglia's xorshift with 32 bits. */
export class Random {
  #state: number;

  /** @param seed not 0 */
  constructor(seed: number) {
    this.#state = seed;
  }

  /** A random integer from 0 to 2^32 - 1. */
  #next(): number {
    this.#state ^= this.#state << 13;
    this.#state ^= this.#state >>> 17;
    this.#state ^= this.#state << 5;
    this.#state >>>= 0;
    return this.#state;
  }

  /** A random number from 0 to less than 1. */
  unit(): number {
    return this.#next() / 2 ** 32;
  }

  /** A random integer from 0 to less than `bound`. */
  below(bound: number): number {
    return Math.floor(this.unit() * bound);
  }

  /** A random one of these choices. */
  of<T>(choices: readonly T[]): T {
    return choices[this.below(choices.length)] as T;
  }

  bytes(length: number): Uint8Array<ArrayBuffer> {
    return Uint8Array.from({ length }, () => this.below(256));
  }
}
