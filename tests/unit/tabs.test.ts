/** The sessions that tabs have open, by locks like those of a browser. */
import { expect, test } from 'vitest';
import { browserTabs } from '../../www/keep/tabs.ts';

/** The locks of one browser: a name has one holder, and the others wait in their order until it is released. */
class Locks {
  readonly #held = new Map<string, Promise<void>>();

  /** The locks of one tab; `close` releases all of them, as the end of a tab does. */
  tab(): { readonly manager: LockManager; close(): void } {
    const ends: (() => void)[] = [];
    const request = async (name: string, { signal }: { signal: AbortSignal }, callback: () => Promise<void>): Promise<void> => {
      const given = new Promise<never>((_, reject) => {
        signal.addEventListener('abort', () => {
          reject(new DOMException('', 'TimeoutError'));
        });
      });
      given.catch(() => undefined);
      while (this.#held.has(name)) {
        await Promise.race([this.#held.get(name), given]);
      }
      const closed = new Promise<void>((end) => ends.push(end));
      const held = Promise.race([callback(), closed]).then(() => {
        this.#held.delete(name);
      });
      this.#held.set(name, held);
      return held;
    };
    const query = (): Promise<LockManagerSnapshot> =>
      Promise.resolve({ held: [...this.#held.keys(), 'another page’s'].map((name) => ({ name })), pending: [] });
    return {
      manager: { request, query } as unknown as LockManager,
      close: () => {
        ends.forEach((end) => {
          end();
        });
      },
    };
  }
}

test('a session is one tab’s until that gives it free or is closed', async () => {
  const locks = new Locks();
  const [first, second] = [locks.tab(), locks.tab()];
  const [one, other] = [browserTabs(first.manager), browserTabs(second.manager)];
  expect(await one.claim('a', 5)).toBe(true);
  expect(await one.claim('b', 5)).toBe(true);
  expect(await other.claim('a', 5)).toBe(false);
  expect(await other.open()).toEqual(new Set(['a', 'b']));
  one.release('a');
  one.release('unknown');
  expect(await other.claim('a', 50)).toBe(true);
  expect(await one.claim('a', 5)).toBe(false);
  // A page that is reloaded waits a moment for its own lock.
  const claimed = other.claim('b', 1000);
  first.close();
  expect(await claimed).toBe(true);
});
