/** The search for landmarks: from no pair to a certified map, and back by one step. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { ownFiles } from './own-files.ts';
import { openDemo, openStep, pairs, ROOT, runMap } from './page.ts';

/** Checks that each answer has a picture of both meshes, which turns with the views. */
async function seePictures(page: Page): Promise<void> {
  const pictures = page.locator('.answers canvas');
  await expect(pictures).toHaveCount(await page.locator('.answers li').count());
  for (const picture of [pictures.last(), pictures.first()]) {
    await picture.scrollIntoViewIfNeeded();
    const painted = (): Promise<number> =>
      picture.evaluate((canvas: HTMLCanvasElement) => {
        const { data } = canvas.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height) ?? { data: [] };
        return data.filter((value, index) => index % 4 === 3 && value > 128).length / (canvas.width * canvas.height);
      });
    await expect.poll(painted, { message: 'it shows both meshes' }).toBeGreaterThan(0.1);
  }
  const first = (): Promise<string> => pictures.first().evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
  const before = await first();
  await page.locator('#view-source').focus();
  await page.keyboard.press('ArrowLeft');
  await expect.poll(first, { message: 'it turns with the views' }).not.toBe(before);
}

test('landmarks are found for meshes without any, and the map goes through them', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Clear all' }).click();
  await expect(pairs(page)).toHaveCount(0);
  await expect(page.locator('#run')).toBeDisabled();

  // While it goes on, both views show the best pairs so far as ghosts. A search that is given up leaves nothing behind.
  const find = page.getByRole('button', { name: 'Find landmarks' });
  const progress = page.getByRole('progressbar', { name: 'Looking for landmarks' });
  await find.click();
  await expect(progress).toBeVisible();
  const labels = page.locator('.labels span:visible');
  for (const view of ['#view-source', '#view-target']) {
    await expect(page.locator(view).locator(labels).first()).toHaveText(/^\d+\?$/, { timeout: 60_000 });
  }
  await expect(pairs(page)).toHaveCount(0);
  await page.screenshot({ path: `${ROOT}test-results/ghost-pairs.png` });
  await page.getByRole('button', { name: 'Stop looking' }).click();
  await expect(progress).toBeHidden();
  await expect(labels).toHaveCount(0);
  await expect(pairs(page)).toHaveCount(0);

  // For two meshes of the user the search begins by itself, and a click on one of them would end it. When it is finished, it has placed
  // pairs and says how sure they are, and the page opens their list.
  const { horse, cat } = ownFiles();
  await openStep(page, 'meshes');
  await page.locator('#source-file').setInputFiles(horse);
  await expect(page.locator('#view-source')).toContainText('horse.obj');
  await expect(page.locator('.searching')).toHaveCount(0);
  await page.locator('#target-file').setInputFiles(cat);
  // The map of the best pairs so far is seen soon.
  await expect(page.locator('#view-source')).toContainText('coarse map', { timeout: 60_000 });
  const told = page.locator('.matched .told');
  await expect(told).toHaveText(/^(Sure|Doubtful)\. /, { timeout: 120_000 });
  await expect(page.locator('#view-source')).not.toContainText('coarse map');
  await expect(labels.filter({ hasText: '?' })).toHaveCount(0);
  await expect(page.locator('#step-landmarks')).toHaveAttribute('aria-current', 'step');
  const found = await pairs(page).count();
  expect(found).toBeGreaterThanOrEqual(4);
  await expect(page.locator('.toast')).toContainText(`${found} landmark pairs found.`);
  await page.screenshot({ path: `${ROOT}test-results/found-landmarks.png` });
  await runMap(page);

  // The pairs came in one step; the answers stay, and can be taken again.
  await openStep(page, 'landmarks');
  await page.locator('#view-source').focus();
  await page.keyboard.press('Control+z');
  await expect(pairs(page)).toHaveCount(0);
  await page.getByText(/^\d+ other answers?$/).click();
  await seePictures(page);
  const best = page.getByRole('button', { name: /^The best answer/ });
  await expect(best).toHaveAttribute('aria-pressed', 'false');
  await best.click();
  await expect(best).toHaveAttribute('aria-pressed', 'true');
  await expect(pairs(page)).toHaveCount(found);
  await expect(told).toContainText('Chosen by you.');
  await page.screenshot({ path: `${ROOT}test-results/found-answers.png` });
  await page.getByRole('button', { name: 'Hide what was found' }).click();
  await expect(told).toBeHidden();
  await expect(pairs(page)).toHaveCount(found);
});
