/** The table of landmarks: used by keys and by mouse, undone by a toast, and fast with many rows. */
import { readFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { openDemo, openStep, pairs } from './page.ts';

async function numbers(page: Page): Promise<string[]> {
  return page.locator('#landmark-list .swatch').allTextContents();
}

test.beforeEach(async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
});

test('the keyboard selects, reorders, renames, locks and deletes', async ({ page }) => {
  const rows = pairs(page);
  const before = await numbers(page);
  await rows.nth(0).focus();
  await page.keyboard.press('ArrowDown');
  await expect(rows.nth(1)).toHaveAttribute('aria-selected', 'true');
  await expect(rows.nth(1)).toBeFocused();
  await page.keyboard.press('Alt+ArrowUp');
  expect((await numbers(page)).slice(0, 3)).toEqual(['2', '1', '3']);
  await expect(rows.nth(0)).toBeFocused();
  await page.keyboard.press('F2');
  await page.keyboard.type('left ear');
  await page.keyboard.press('Enter');
  await expect(rows.nth(0).locator('input')).toHaveValue('left ear');
  await expect(rows.nth(0)).toBeFocused();
  await page.keyboard.press('l');
  await page.keyboard.press('Delete');
  await expect(page.locator('#error')).toContainText('Pair 2 is locked');
  await expect(rows).toHaveCount(before.length);
  await page.keyboard.press('l');
  await page.keyboard.press('Delete');
  await expect(rows).toHaveCount(before.length - 1);
  await expect(rows.nth(0)).toBeFocused();

  // The other pairs keep their numbers; the toast brings the pair back, and undo the rest.
  expect((await numbers(page))[0]).toBe('1');
  await page.locator('#toast').getByRole('button', { name: 'Undo' }).click();
  await expect(rows).toHaveCount(before.length);
  await expect(rows.nth(0).locator('input')).toHaveValue('left ear');
  for (let step = 0; step < 4; step++) {
    await page.locator('#undo').click();
  }
  expect(await numbers(page)).toEqual(before);
  await expect(page.locator('#redo')).toBeEnabled();
});

test('a row is dragged by its number', async ({ page }) => {
  const swatches = page.locator('#landmark-list .swatch');
  await swatches.nth(0).dragTo(swatches.nth(3));
  expect((await numbers(page)).slice(0, 4)).toEqual(['2', '3', '4', '1']);
});

test('a name is saved with the file', async ({ page }) => {
  await pairs(page).nth(0).locator('input').fill('tip of the nose');
  await pairs(page).nth(0).locator('input').press('Enter');
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save file' }).click();
  const saved = JSON.parse(readFileSync(await (await download).path(), 'utf8')) as { labels: string[] };
  expect(saved.labels[0]).toBe('tip of the nose');
});

test('with a hundred pairs a choice changes two rows and no other', async ({ page }) => {
  const list = Array.from({ length: 100 }, (_, k) => [5 * k, 5 * k]);
  await page.locator('#landmark-file').setInputFiles({
    name: 'many.json',
    mimeType: 'application/json',
    buffer: Buffer.from(JSON.stringify({ pairs: list })),
  });
  await expect(pairs(page)).toHaveCount(100);
  const changed = await page.evaluate(async () => {
    const rows = [...document.querySelectorAll<HTMLElement>('#landmark-list [data-pair]')];
    const settled = (): Promise<void> =>
      new Promise((resolve) => {
        setTimeout(resolve, 100);
      });
    rows[3]?.querySelector('td')?.click();
    await settled();
    const touched = new Set<Element | null>();
    const observer = new MutationObserver((records) => {
      for (const { target } of records) {
        touched.add((target instanceof Element ? target : target.parentElement)?.closest('[data-pair]') ?? null);
      }
    });
    const table = document.querySelector('#landmark-list');
    if (table !== null) {
      observer.observe(table, { attributes: true, childList: true, characterData: true, subtree: true });
    }
    rows[40]?.querySelector('td')?.click();
    await settled();
    return rows.flatMap((row, k) => (touched.has(row) ? [k] : []));
  });
  expect(changed).toEqual([3, 40]);
});
