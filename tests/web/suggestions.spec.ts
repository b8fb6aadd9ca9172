/** Suggested landmarks: taken by a click on a ring, by the keyboard, or all at once. */
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { expect, test } from '@playwright/test';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

async function open(page: Page): Promise<void> {
  await page.goto('/#demo=horse-cat');
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
}

test('suggestions are taken one by one and all at once', async ({ page }) => {
  await open(page);
  await page.getByRole('button', { name: 'Clear all' }).click();
  await page.getByRole('button', { name: 'Suggest landmarks on the source' }).click();
  const rings = page.locator('#view-source .rings button');
  await expect(rings).toHaveCount(12);
  await page.waitForTimeout(500);
  await page.screenshot({ path: `${ROOT}test-results/suggestions.png` });

  // A ring by a click, then its place on the target by a ring and the keyboard.
  const pairs = page.locator('#landmark-list [data-pair]');
  const visible = rings.locator('visible=true');
  await visible.first().click();
  await expect(rings).toHaveCount(11);
  await expect(page.locator('#hint')).toContainText('on the target to finish pair 1');
  await page.getByRole('button', { name: 'Suggest landmarks on the target' }).click();
  await expect(page.locator('#view-target .rings button')).toHaveCount(12);
  await page.locator('#suggestions .ring').last().focus();
  await page.keyboard.press('Enter');
  await expect(pairs).toHaveCount(1);

  // The rest at once: every pick on the target brings the next point.
  await page.getByRole('button', { name: 'Take all 11' }).first().click();
  await expect(rings).toHaveCount(0);
  await expect(page.locator('#hint')).toContainText('10 more wait');
  await page.locator('#suggestions .ring').first().click();
  await expect(pairs).toHaveCount(2);
  await expect(page.locator('#hint')).toContainText('finish pair 3. 9 more wait');
  await page.locator('#view-target').focus();
  await page.keyboard.press('Escape');
  await expect(page.locator('#hint')).toContainText('finish pair 3. 8 more wait');
});

test('a limb without a landmark is named and shown', async ({ page }) => {
  await open(page);
  const labels = await page.locator('#landmark-list input').evaluateAll((inputs) => inputs.map((input) => (input as HTMLInputElement).value));
  const tail = labels.findIndex((label) => label.startsWith('tail'));
  await page.getByRole('button', { name: `Delete pair ${tail + 1}`, exact: true }).click();
  await page.locator('#run').click();
  await expect(page.locator('#findings')).toContainText(/A limb of the source has no landmark: its end is vertex \d+/, { timeout: 60_000 });
  await page.getByRole('button', { name: 'Show with rings' }).first().click();
  await expect(page.locator('#view-source .rings button')).toHaveCount(1);
  await page.screenshot({ path: `${ROOT}test-results/limb.png` });
});
