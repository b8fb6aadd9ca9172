/** The discrete conformal structures of the flows in the step Method: each by its name, and the place at which one without flips stops. */
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { countPixels, pixelsOf, SETTLED } from './canvas.ts';
import { CORNERS, rod } from '../unit/rod.ts';
import { upload } from './own-files.ts';
import { open, openStep, ROOT, runMap } from './page.ts';

const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

/** The number of pixels of a view that have, at least nearly, the colour of triangles that stop a flow. */
async function painted(page: Page, view: string): Promise<number> {
  return countPixels(await pixelsOf(page, view), (r, g, b) => Math.hypot(r - 208, g - 28, b - 139) < 40);
}

test('every structure has its flow, and the triangle that stops the one without flips is painted, told and brought into sight', { tag: '@long' }, async ({ page }) => {
  await open(page);
  // The files are chosen one after the other, faster than they are read.
  await page.locator('#source-file').setInputFiles(upload('rod.obj', rod(8)));
  await page.locator('#target-file').setInputFiles(upload('ball.obj', rod(1)));
  await page.locator('#landmark-file').setInputFiles(upload('corners.json', CORNERS));
  await expect(page.locator('#run')).toBeEnabled();
  await runMap(page);
  await openStep(page, 'method');
  await page.locator('#watch-flow').click();
  const converged = async (side: number): Promise<boolean> => {
    const text = (await page.locator(`[data-flow="${side}"] td`).nth(1).textContent()) ?? '';
    return text.includes('·10⁻') && (await page.locator(`[data-stopped="${side}"]`).count()) === 0;
  };
  const structures = page.getByRole('radiogroup', { name: 'The discrete conformal structure of the flow' });
  for (const name of ['Inversive distance', 'Vertex scaling', 'Touching circles', 'Overlapping circles']) {
    await structures.getByRole('radio', { name, exact: true }).check();
    await expect(page.locator('.flow-numbers'), name).toBeVisible({ timeout: 60_000 });
    const slider = page.getByRole('slider', { name: 'Step of the flow' });
    await slider.focus();
    await page.keyboard.press('End');
    await expect.poll(() => Promise.all([converged(0), converged(1)]), { message: name }).toEqual([true, true]);
  }
  // Every vertex has a circle, except where the structure has none.
  const circles = page.getByRole('checkbox', { name: 'Circles on the meshes' });
  const dark = async (view: string): Promise<number> => countPixels(await pixelsOf(page, view), (r, g, b) => Math.max(r, g, b) < 60);
  const ringless = [await dark('#view-source'), await dark('#view-target')] as const;
  await circles.check();
  await expect.poll(() => dark('#view-source')).toBeGreaterThan(ringless[0] + 200);
  await expect.poll(() => dark('#view-target')).toBeGreaterThan(ringless[1] + 200);
  await page.screenshot({ path: `${ROOT}test-results/flow-circles.png` });
  await circles.uncheck();
  await expect.poll(() => dark('#view-source')).toBeLessThan(ringless[0] + 50);
  await structures.getByRole('radio', { name: 'Vertex scaling', exact: true }).check();
  await expect(circles).toBeDisabled({ timeout: 60_000 });
  const before = await painted(page, '#view-source');
  await structures.getByRole('radio', { name: 'Inversive distance, no flips', exact: true }).check();
  const told = page.locator('[data-stopped="0"]');
  await expect(told).toContainText(/The source’s flow stops after \d+ steps, .*: beyond, .*triangles? ha(s|ve) no area/, { timeout: 60_000 });
  // The mark in the triangle's middle, and the visible part of the triangle.
  await expect.poll(() => painted(page, '#view-source')).toBeGreaterThan(before + 20);
  await told.getByRole('button', { name: /^Show face \d+$/ }).first().click();
  await page.waitForTimeout(SETTLED + 800);
  expect(await painted(page, '#view-source')).toBeGreaterThan(before + 200);
  await told.scrollIntoViewIfNeeded();
  await page.screenshot({ path: `${ROOT}test-results/flow-stopped.png` });
  const { violations } = await new AxeBuilder({ page }).include('#panel').withTags(RULES).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  // The paint is removed by another structure, and by leaving the flow.
  await structures.getByRole('radio', { name: 'Touching circles', exact: true }).check();
  await expect.poll(() => painted(page, '#view-source')).toBeLessThan(before + 10);
  await page.locator('#close-flow').click();
  await expect(page.locator('#watch-flow')).toBeVisible();
});
