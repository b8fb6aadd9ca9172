/** Files are read in workers: the page can be used while a large mesh is read, can give it up, and survives a reader that breaks. */
import type { JSHandle, Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { dropContents, fail, open, openDemo, TETRAHEDRON } from './page.ts';

/** The large meshes have about twice the square of these numbers of triangles. */
const LARGE = 320;
const LARGER = 500;

/** A dented ball with many triangles as a file to drop. It is made in the page, which is quicker than sending it there. */
async function largeMesh(page: Page, rows: number): Promise<JSHandle<DataTransfer>> {
  return page.evaluateHandle((rows) => {
    const lines: string[] = ['v 0 0 1', 'v 0 0 -1'];
    const number = (row: number, column: number): number => 3 + row * rows + (column % rows);
    for (let row = 0; row < rows; row += 1) {
      for (let column = 0; column < rows; column += 1) {
        const [turn, height] = [(2 * Math.PI * column) / rows, (Math.PI * (row + 1)) / (rows + 1)];
        const radius = 1 + 0.1 * Math.sin(5 * turn) * Math.sin(height);
        const place = [Math.cos(turn) * Math.sin(height), Math.sin(turn) * Math.sin(height), Math.cos(height)];
        lines.push(`v ${place.map((x) => (x * radius).toFixed(9)).join(' ')}`);
      }
    }
    for (let column = 0; column < rows; column += 1) {
      lines.push(`f 1 ${number(0, column)} ${number(0, column + 1)}`, `f 2 ${number(rows - 1, column + 1)} ${number(rows - 1, column)}`);
      for (let row = 0; row + 1 < rows; row += 1) {
        const [a, b, c, d] = [number(row, column), number(row + 1, column), number(row + 1, column + 1), number(row, column + 1)];
        lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
      }
    }
    const transfer = new DataTransfer();
    transfer.items.add(new File([lines.join('\n')], 'large.obj'));
    return transfer;
  }, rows);
}

/** Counts the page's frames and measures its longest task, in ms, from now on. */
async function watch(page: Page): Promise<() => Promise<{ readonly longest: number; readonly frames: number; readonly took: number }>> {
  const watching = await page.evaluateHandle(() => {
    const seen = { longest: 0, frames: 0, begun: performance.now() };
    const note = (entries: PerformanceEntryList): void => {
      seen.longest = Math.max(seen.longest, ...entries.map(({ duration }) => duration));
    };
    const observer = new PerformanceObserver((list) => {
      note(list.getEntries());
    });
    observer.observe({ type: 'longtask' });
    const count = (): void => {
      seen.frames += 1;
      requestAnimationFrame(count);
    };
    requestAnimationFrame(count);
    return {
      seen: () => {
        note(observer.takeRecords());
        return { ...seen, took: performance.now() - seen.begun };
      },
    };
  });
  return () => watching.evaluate(({ seen }) => seen());
}

const STATUS = '#status';

test('a large mesh is read while the page draws its frames', { tag: '@alone' }, async ({ page }) => {
  await openDemo(page);
  const transfer = await largeMesh(page, LARGE);
  // The work that the demo has begun in workers is over.
  await page.waitForTimeout(3000);
  const watched = await watch(page);
  await page.locator('#view-source').dispatchEvent('drop', { dataTransfer: transfer });
  await expect(page.locator(STATUS)).toHaveText('Reading the files…');
  await expect(page.locator(STATUS)).not.toHaveText('Reading the files…', { timeout: 120_000 });
  const { longest, frames, took } = await watched();
  await expect(page.locator('body')).toContainText('large');
  // A page that read by itself would have one task as long as the whole, with a frame before and after it.
  expect(longest, `of ${took} ms, in which it drew ${frames} frames`).toBeLessThan(took / 4);
  expect(frames).toBeGreaterThan(5);
  // The data that a click on such a mesh needs is made between the frames.
  await expect(async () => {
    await page.locator('#view-source').click({ force: true });
    await expect(page.locator('#hint')).toContainText('now click the same place', { timeout: 1000 });
  }).toPass();
});

test('reading can be left, and what was there stays', async ({ page }) => {
  await openDemo(page);
  const names = await page.locator('.caption').allInnerTexts();
  const transfer = await largeMesh(page, LARGER);
  await page.locator('#view-source').dispatchEvent('drop', { dataTransfer: transfer });
  await page.locator('#leave-task').click();
  await expect(page.locator(STATUS)).not.toHaveText('Reading the files…', { timeout: 1000 });
  await expect(page.locator('#run')).toBeEnabled();
  await page.locator('#view-source').dispatchEvent('drop', { dataTransfer: transfer });
  await expect(page.locator(STATUS)).toHaveText('Reading the files…');
  await page.keyboard.press('Escape');
  await expect(page.locator(STATUS)).not.toHaveText('Reading the files…', { timeout: 1000 });
  expect(await page.locator('.caption').allInnerTexts()).toEqual(names);
  // The next file does not wait for the one that was given up.
  await dropContents(page, [{ name: 'small.obj', content: TETRAHEDRON }]);
  await expect(page.locator('body')).toContainText('small', { timeout: 10_000 });
  await expect(page.locator('#error')).toBeHidden();
});

test('a reader that breaks is told in a sentence, and the next file has a fresh one', async ({ page }) => {
  await open(page);
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  // The reader of meshes is begun with the first mesh.
  await dropContents(page, [{ name: 'earliest.obj', content: TETRAHEDRON }]);
  await expect(page.locator('body')).toContainText('earliest');
  const reader = page.workers().find((worker) => worker.url().includes('/mesh-worker-')) ?? fail('there is no reader');
  await reader.evaluate(() => {
    self.postMessage = () => {
      throw new Error('no memory');
    };
  });
  await dropContents(page, [{ name: 'small.obj', content: TETRAHEDRON }]);
  await expect(page.locator('#error')).toContainText('could not be started or broke off');
  await dropContents(page, [{ name: 'small.obj', content: TETRAHEDRON }]);
  await expect(page.locator('body')).toContainText('small');
  await expect(page.locator('#error')).toBeHidden();
});
