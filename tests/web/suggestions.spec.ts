/** Suggested landmarks: taken by a click on a ring, by the keyboard, or all at once. */
import { expect, test } from './test.ts';
import { openDemo, openStep, pairs, ROOT } from './page.ts';

test('suggestions are taken one by one and all at once', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Clear all' }).click();
  await page.getByRole('button', { name: 'Suggest landmarks on the source' }).click();
  const rings = page.locator('#view-source .rings button');
  await expect(rings).toHaveCount(12);
  await page.waitForTimeout(500);
  await page.screenshot({ path: `${ROOT}test-results/suggestions.png` });

  // A ring is taken by a click, and then its partner on the target by a ring and the keyboard.
  const rows = pairs(page);
  const visible = rings.locator('visible=true');
  await visible.first().click();
  await expect(rings).toHaveCount(11);
  await expect(page.locator('#hint')).toContainText('Pair 1: now click the same place on the target.');
  await page.getByRole('button', { name: 'Suggest landmarks on the target' }).click();
  await expect(page.locator('#view-target .rings button')).toHaveCount(12);
  await page.locator('.suggestions .ring').last().focus();
  await page.keyboard.press('Enter');
  await expect(rows).toHaveCount(1);

  // The rest is taken at once: each pick on the target brings up the next point.
  await page.getByRole('button', { name: 'Take all 11' }).first().click();
  await expect(rings).toHaveCount(0);
  await expect(page.locator('#hint')).toContainText('10 more wait');
  await page.locator('.suggestions .ring').first().click();
  await expect(rows).toHaveCount(2);
  await expect(page.locator('#hint')).toContainText('Pair 3: now click the same place on the target. 9 more wait');
  await page.locator('#view-target').focus();
  await page.keyboard.press('Escape');
  await expect(page.locator('#hint')).toContainText('Pair 4: now click the same place on the target. 8 more wait');
});

test('a limb without a landmark is named and shown', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const labels = await page.locator('#landmark-list input').evaluateAll((inputs) => inputs.map((input) => (input as HTMLInputElement).value));
  const tail = labels.findIndex((label) => label.startsWith('tail'));
  await page.getByRole('button', { name: `Delete pair ${tail + 1}`, exact: true }).click();
  await page.locator('#run').click();
  await expect(page.locator('#findings')).toContainText(/A limb of the source has no landmark: its end is vertex \d+/, { timeout: 60_000 });
  await page.getByRole('button', { name: 'Show with rings' }).first().click();
  await expect(page.locator('#view-source .rings button')).toHaveCount(1);
  await page.screenshot({ path: `${ROOT}test-results/limb.png` });
});
