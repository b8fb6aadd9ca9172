/** Where the true map is known, the page shows how far a map is from it. */
import { expect, test } from './test.ts';
import { openDemo, openStep, runMap, showSurface } from './page.ts';

const TRUTH = 'Distance to the truth';

test('a demo with a known map has the distance to it in figures and in colours', { tag: '@long' }, async ({ page }) => {
  await openDemo(page, '#demo=horse-turning');
  await page.getByRole('button', { name: /^Picture: / }).click();
  await expect(page.getByRole('radio', { name: 'Distortion' })).toBeVisible();
  await expect(page.getByRole('radio', { name: TRUTH })).toHaveCount(0);
  await page.keyboard.press('Escape');
  await runMap(page);
  await openStep(page, 'map');
  await page.getByText('Details', { exact: true }).click();
  await expect(page.locator('#details')).toContainText(/True images\s*mean 0\.0\d+, 95 % below 0\.0\d+ away/);
  await showSurface(page, TRUTH);
  await expect(page.getByText('1 % and more')).toBeVisible();
  await showSurface(page, 'Distortion');
  await expect(page.getByText('4 and more')).toBeVisible();
});
