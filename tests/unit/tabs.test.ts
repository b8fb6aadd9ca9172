/** Sessions that tabs have open, by locks as browsers give them. */
import { expect, test } from 'vitest';
import { browserTabs } from '../../www/keep/tabs.ts';

/** Locks of one browser: one holder for a name, the others wait in their order until they are given up. */
class Locks {
  readonly #held = new Map<string, Promise<void>>();

  /** The locks as one tab has them; `close` lets all of them go, as the end of a tab does. */
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
  // A page that is reloaded waits a moment for itself.
  const claimed = other.claim('b', 1000);
  first.close();
  expect(await claimed).toBe(true);
});
