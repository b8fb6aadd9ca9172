/** The way of the source to the target's shape: at first straight, then one on which limbs turn. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { pixelsOf, SETTLED } from './canvas.ts';
import { openDemo, runMap } from './page.ts';

/** Holds back all requests for the way until `letWay` is called. */
async function holdWay(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const held: (() => void)[] = [];
    Reflect.set(window, 'letWay', () => {
      held.forEach((post) => {
        post();
      });
      return held.length;
    });
    const post = Reflect.get(Worker.prototype, 'postMessage') as (...all: unknown[]) => void;
    Worker.prototype.postMessage = function (...all: unknown[]): void {
      const send = (): void => {
        Reflect.apply(post, this, all);
      };
      if ((all[0] as { readonly kind?: string } | null)?.kind === 'way') {
        held.push(send);
      } else {
        send();
      }
    };
  });
}

async function letWay(page: Page): Promise<number> {
  return page.evaluate(() => (Reflect.get(window, 'letWay') as () => number)());
}

/** The number of pixels of the source's view that differ by more than shading. */
function differing(one: Uint8Array, other: Uint8Array): number {
  let count = 0;
  for (let at = 0; at < one.length; at += 4) {
    const by = Math.max(...[0, 1, 2].map((k) => Math.abs((one[at + k] ?? 0) - (other[at + k] ?? 0))));
    count += by > 24 ? 1 : 0;
  }
  return count;
}

async function shownAt(page: Page, percent: number): Promise<Uint8Array> {
  await page.getByRole('slider', { name: 'Shape of the source' }).fill(String(percent));
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  return pixelsOf(page, '#view-source');
}

test('half-way limbs are turned where straight lines shrink them, and both ends are as before', { tag: '@long' }, async ({ page }) => {
  await holdWay(page);
  await openDemo(page, '#demo=poses');
  await runMap(page);
  const [own, straight, target] = [await shownAt(page, 0), await shownAt(page, 50), await shownAt(page, 100)];
  expect(differing(own, straight)).toBeGreaterThan(3000);
  await shownAt(page, 50);
  await expect.poll(() => letWay(page)).toBe(1);
  await expect.poll(async () => differing(straight, await pixelsOf(page, '#view-source')), { timeout: 60_000 }).toBeGreaterThan(1000);
  const bent = await pixelsOf(page, '#view-source');
  expect(differing(own, bent)).toBeGreaterThan(1000);
  expect(differing(target, await shownAt(page, 100))).toBeLessThan(20);
  expect(differing(own, await shownAt(page, 0))).toBe(0);
  expect(differing(bent, await shownAt(page, 50))).toBe(0);
});
