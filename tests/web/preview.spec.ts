/** The preview of the map that is being made: it is shown soon after the start, refined, and removed at the end of the run. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { keepPreviews, SETTLED } from './canvas.ts';
import { finished, LONG_RUN, openDemo, openStep } from './page.ts';

async function source(page: Page): Promise<Buffer> {
  const box = await page.locator('#view-source').boundingBox();
  if (box === null) {
    throw new Error('the view is not there');
  }
  // The caption, which mentions the coarse map, is left out.
  return page.screenshot({ clip: { x: box.x, y: box.y + 48, width: box.width, height: box.height - 120 } });
}

test('the coarse map is seen while the run goes on, and is gone with it', async ({ page }) => {
  await openDemo(page, LONG_RUN);
  await openStep(page, 'map');
  await page.waitForTimeout(SETTLED);
  const before = await source(page);
  const coarse = page.locator('#view-source .coarse-map');
  await page.locator('#run').click();
  await expect(coarse).toBeVisible({ timeout: 30_000 });
  await page.waitForTimeout(200);
  expect((await source(page)).equals(before)).toBe(false);
  await page.locator('#cancel').click();
  await expect(coarse).toHaveCount(0);
  await openStep(page, 'map');
  await page.waitForTimeout(SETTLED);
  expect((await source(page)).equals(before)).toBe(true);
});

test('previews come nearer to the map, and are gone at its end', async ({ page }) => {
  await keepPreviews(page);
  await openDemo(page, LONG_RUN);
  await openStep(page, 'map');
  await page.locator('#run').click();
  await finished(page);
  await expect(page.locator('#view-source .coarse-map')).toHaveCount(0);
  // There are several different previews, with a place for each vertex of the source, and the last ones differ less than the first ones.
  const steps = await page.evaluate(() => {
    const previews = (Reflect.get(window, 'previews') as { places: Float32Array }[]).map(({ places }) => places);
    const between = (a: Float32Array, b: Float32Array): number =>
      a.reduce((sum, x, k) => sum + Math.abs(x - (b[k] ?? 0)), 0) / a.length;
    const last = previews.at(-1) ?? new Float32Array();
    return previews.map((places) => (places.length === last.length ? between(places, last) : Number.NaN));
  });
  expect(steps.length).toBeGreaterThan(2);
  expect(steps.every((step) => Number.isFinite(step))).toBe(true);
  expect(steps[0]).toBeGreaterThan(0);
  expect(steps.at(-2) ?? 0).toBeLessThan(steps[0] ?? 0);
});
