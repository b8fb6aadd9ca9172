/**
 * What the browser fetches before a mesh can be dropped: neither equations nor plots, which are fetched on demand, nor the core, which
 * reads meshes and makes maps and is fetched afterwards.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Page, Request } from '@playwright/test';
import { expect, test } from './test.ts';
import { dropContents, fail, kept, open, openDemo, ROOT, runMap, TETRAHEDRON } from './page.ts';

const ASSETS = join(ROOT, 'dist/assets');
/** The most bytes of the first load, packed with gzip. */
const LARGEST_FIRST_LOAD = 150_000;

/** The scripts that index.html asks for, with everything that they import statically. */
function firstScripts(): ReadonlyMap<string, string> {
  const found = new Map<string, string>();
  const visit = (name: string): void => {
    if (!found.has(name)) {
      const code = readFileSync(join(ASSETS, name), 'utf8');
      found.set(name, code);
      for (const [, imported] of code.matchAll(/(?:from|import)\s*"\.\/([\w.-]+\.js)"/g)) {
        visit(imported ?? '');
      }
    }
  };
  const html = readFileSync(join(ROOT, 'dist/index.html'), 'utf8');
  for (const [, name] of html.matchAll(/(?:src|href)="\.\/assets\/([\w.-]+\.js)"/g)) {
    visit(name ?? '');
  }
  return found;
}

test('the first load has no part of KaTeX and uPlot, and stays small', () => {
  const first = firstScripts();
  expect(first.size).toBeGreaterThan(0);
  const all = readdirSync(ASSETS).filter((name) => name.endsWith('.js'));
  for (const sign of [/katex/i, /u-hz/]) {
    const holding = all.filter((name) => sign.test(readFileSync(join(ASSETS, name), 'utf8')));
    expect(holding.length, `${sign.source} is in the build`).toBeGreaterThan(0);
    expect(holding.filter((name) => first.has(name)), `${sign.source} is not in the first load`).toEqual([]);
  }
  const size = [...first.values()].reduce((sum, code) => sum + gzipSync(code).length, 0);
  expect(size).toBeLessThan(LARGEST_FIRST_LOAD);
});

const CORE = /\/core_bg[^/]*\.wasm$/;
/** The pictures of the gallery, which are fetched when the demos can be opened. */
const PICTURE = /\/demos\/[^/]*$/;
/** The most bytes of all files, packed with brotli. */
const BUDGET = 1_000_000;

/** Opens the page, waits until it asks for the core, and returns the requests before that, without the gallery's pictures. */
async function firstRequests(page: Page): Promise<readonly Request[]> {
  const requests: Request[] = [];
  page.on('request', (request) => {
    requests.push(request);
  });
  const core = page.waitForRequest((request) => CORE.test(request.url()));
  await open(page);
  await core;
  const urls = requests.map((request) => request.url());
  const after = urls.findIndex((url) => CORE.test(url) || PICTURE.test(url));
  return requests.slice(0, after).filter((request) => request.url().startsWith('http'));
}

async function packedSize(request: Request): Promise<number> {
  const response = await request.response();
  const body = (await response?.body()) ?? fail(`${request.url()} has no body`);
  return brotliCompressSync(body, { params: { [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: body.length } }).length;
}

test.describe('a visit as users have it', () => {
  test.use({ warmsCore: true });

  test('the core is asked for when the page can be used', async ({ page }) => {
    const first = await firstRequests(page);
    expect(first.filter((request) => request.url().includes('page_bg'))).toHaveLength(1);
  });

  // This checks the modules as they are published, which the short tests do without.
  test('the first load is small', { tag: '@long' }, async ({ page }) => {
    const first = await firstRequests(page);
    const sizes = await Promise.all(first.map(packedSize));
    const list = first.map((request, k) => `${request.url().replace(/.*\//, '')} ${sizes[k]}`).join(', ');
    expect(sizes.reduce((sum, size) => sum + size, 0), list).toBeLessThan(BUDGET);
  });

  test('the core is warmed while nobody asks for a map, by a worker that ends', async ({ page }) => {
    const warming = page.waitForEvent('worker', (worker) => worker.url().includes('/warmer-'));
    await openDemo(page);
    const warmer = await warming;
    const ended = warmer.waitForEvent('close');
    await page.locator('#run').click();
    await ended;
  });
});

/** Holds a file back until the returned function is called. */
async function held(page: Page, file: RegExp): Promise<() => void> {
  let letThrough = (): void => undefined;
  const opened = new Promise<void>((resolve) => {
    letThrough = resolve;
  });
  await page.route(file, async (route) => {
    await opened;
    await route.continue();
  });
  return () => {
    letThrough();
  };
}

test('a core that does not come is told, and fetched again by the next try', async ({ page }) => {
  await page.route(CORE, (route) => route.abort());
  await openDemo(page);
  await page.locator('#run').click();
  await expect(page.locator('#error')).toContainText('could not be fetched');
  await page.unroute(CORE);
  await runMap(page);
});

test('a run that is asked for before the core is there begins when it comes', async ({ page }) => {
  const letThrough = await held(page, CORE);
  await openDemo(page);
  await page.locator('#run').click();
  await expect(page.locator('#cancel')).toBeVisible();
  letThrough();
  await expect(page.locator('#result')).toContainText('Certified bijective', { timeout: 200_000 });
});

const SMALL = { name: 'small.obj', content: TETRAHEDRON };

test('a mesh that is dropped before the core is there is read when it comes', async ({ page }) => {
  const letThrough = await held(page, CORE);
  await openDemo(page);
  await dropContents(page, [SMALL]);
  await expect(page.locator('#status')).toHaveText('Reading the files…');
  letThrough();
  await expect(page.locator('.caption').filter({ hasText: 'small' })).toHaveCount(1);
  await expect(page.locator('#error')).toBeHidden();
});

test('a mesh that cannot be read for want of the core is told, and read by the next try', async ({ page }) => {
  await page.route(CORE, (route) => route.abort());
  await openDemo(page);
  await dropContents(page, [SMALL]);
  await expect(page.locator('#error p')).toHaveText(/^small\.obj: The part of the program that reads meshes and makes maps could not be fetched\./);
  await page.unroute(CORE);
  await dropContents(page, [SMALL]);
  await expect(page.locator('.caption').filter({ hasText: 'small' })).toHaveCount(1);
  await expect(page.locator('#error')).toBeHidden();
});

/** The module without which the page can neither show nor open anything. */
const MODULE = /\/page_bg[^/]*\.wasm$/;

/** Opens the page, drops files on it while it is loading, in this order, and waits until it can be used. */
async function openWhileDropping(page: Page, hash: string, files: Parameters<typeof dropContents>[1]): Promise<void> {
  const letThrough = await held(page, MODULE);
  await page.goto(`/${hash}`);
  await expect(page.locator('#status')).toHaveText('Loading…');
  for (const file of files) {
    await dropContents(page, [file]);
  }
  letThrough();
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
}

test('meshes that are dropped while the page is loading come in place of the first demo', async ({ page }) => {
  await openWhileDropping(page, '', [SMALL, { ...SMALL, name: 'second.obj' }]);
  await expect(page.locator('.caption').filter({ hasText: 'small' })).toHaveCount(1);
  await expect(page.locator('.caption').filter({ hasText: 'second' })).toHaveCount(1);
  await expect(page.locator('#error')).toBeHidden();
});

test('a mesh that is dropped while the page is loading comes onto the demo of the address', async ({ page }) => {
  await openWhileDropping(page, '#demo=horse-cat', [SMALL]);
  await expect(page.locator('.caption').filter({ hasText: 'small' })).toHaveCount(1);
  await expect(page.locator('.caption').filter({ hasText: 'cat' })).toHaveCount(1);
});

test('a file that is dropped while the page is loading and cannot be read is told', async ({ page }) => {
  await openWhileDropping(page, '', [{ name: 'broken.obj', content: 'v 0 0\n' }]);
  await expect(page.locator('#error p')).toContainText('broken.obj');
});

test('a mesh that is dropped while the page is loading again comes onto the work that was there', async ({ page }) => {
  await openDemo(page);
  await dropContents(page, [SMALL]);
  await expect(page.locator('.caption').filter({ hasText: 'small' })).toHaveCount(1);
  await kept(page, 0);
  await openWhileDropping(page, '', [{ ...SMALL, name: 'second.obj' }]);
  await expect(page.locator('.caption').filter({ hasText: 'second' })).toHaveCount(1);
  await expect(page.locator('.caption').filter({ hasText: 'cat' })).toHaveCount(1);
});
