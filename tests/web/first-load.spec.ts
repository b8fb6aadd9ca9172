/** What a visit fetches before a mesh can be dropped, and what makes maps, which comes after it. */
import { brotliCompressSync, constants } from 'node:zlib';
import type { Request } from '@playwright/test';
import { expect, test } from '@playwright/test';
import { fail, open, openDemo, runMap } from './page.ts';

const CORE = /\/core_bg[^/]*\.wasm$/;
/** The gallery's pictures: they come when the demos can be opened. */
const PICTURE = /\/demos\/[^/]*$/;
/** In bytes, as a host sends text and programs. */
const BUDGET = 1_200_000;

async function packedSize(request: Request): Promise<number> {
  const response = await request.response();
  const body = (await response?.body()) ?? fail(`${request.url()} has no body`);
  return brotliCompressSync(body, { params: { [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: body.length } }).length;
}

test('the first load is small: the core is asked for when the page can be used', async ({ page }) => {
  const requests: Request[] = [];
  page.on('request', (request) => {
    requests.push(request);
  });
  const core = page.waitForRequest((request) => CORE.test(request.url()));
  await open(page);
  await core;
  const urls = requests.map((request) => request.url());
  const after = urls.findIndex((url) => CORE.test(url) || PICTURE.test(url));
  const first = requests.slice(0, after).filter((request) => request.url().startsWith('http'));
  expect(first.filter((request) => request.url().includes('page_bg'))).toHaveLength(1);
  const sizes = await Promise.all(first.map(packedSize));
  const list = first.map((request, k) => `${request.url().replace(/.*\//, '')} ${sizes[k]}`).join(', ');
  expect(sizes.reduce((sum, size) => sum + size, 0), list).toBeLessThan(BUDGET);
});

test('a core that does not come is told, and fetched again by the next try', async ({ page }) => {
  await page.route(CORE, (route) => route.abort());
  await openDemo(page);
  await page.locator('#run').click();
  await expect(page.locator('#error')).toContainText('could not be fetched');
  await page.unroute(CORE);
  await runMap(page);
});

test('a run that is asked for before the core is there begins when it comes', async ({ page }) => {
  let letThrough = (): void => undefined;
  const opened = new Promise<void>((resolve) => {
    letThrough = resolve;
  });
  await page.route(CORE, async (route) => {
    await opened;
    await route.continue();
  });
  await openDemo(page);
  await page.locator('#run').click();
  await expect(page.locator('#cancel')).toBeVisible();
  letThrough();
  await expect(page.locator('#result')).toContainText('Certified bijective', { timeout: 200_000 });
});
