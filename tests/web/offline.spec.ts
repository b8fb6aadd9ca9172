/** Visits without a network, and a new build that appears while the page is open. */
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { writeServiceWorker } from '../../www/offline/build.ts';
import { runMap } from './page.ts';
import { staticHost } from './static-host.ts';

const DIST = fileURLToPath(new URL('../../dist', import.meta.url));

test.use({ serviceWorkers: 'allow' });

async function isReady(page: Page): Promise<void> {
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
}

/** Waits until the page is kept, and its requests are answered from the cache. */
async function isKept(page: Page): Promise<void> {
  await page.waitForFunction(async () => {
    await navigator.serviceWorker.ready;
    return navigator.serviceWorker.controller !== null;
  });
}

test('after the first visit the page works without a network, from any folder', async ({ page }) => {
  const host = await staticHost(DIST, '/some/sub/path/');
  await page.goto(host.address);
  await isReady(page);
  await isKept(page);
  await host.close();

  for (const hash of ['', '?from=mail#demo=', '#s=3.AAAA', '#demo=sphere-tetrahedron']) {
    await page.goto('about:blank');
    await page.goto(`${host.address}${hash}`);
    await isReady(page);
    // A link that cannot be read does not leave the page empty either.
    await expect(page.locator('body')).not.toHaveAttribute('data-demo', '', { timeout: 60_000 });
  }
  // The worker of runs is kept as well: a map is made without a network.
  await runMap(page);
});

test('a new build tells the open page of itself and comes with a reload', { tag: '@long' }, async ({ page }) => {
  const folder = mkdtempSync(join(tmpdir(), 'conemap-'));
  cpSync(DIST, folder, { recursive: true });
  const host = await staticHost(DIST, '/');
  try {
    await page.goto(host.address);
    await isReady(page);
    await isKept(page);
    await expect(page.locator('#new-version')).toBeHidden();

    const index = join(folder, 'index.html');
    writeFileSync(index, readFileSync(index, 'utf8').replace('<html', '<html data-build="next"'));
    await writeServiceWorker(folder, 'es2022');
    host.serve(folder);
    await page.evaluate(async () => {
      await (await navigator.serviceWorker.ready).update();
    });
    await expect(page.locator('#new-version')).toContainText('A new version of this page is ready.');
    await expect(page.locator('html')).not.toHaveAttribute('data-build');
    await page.locator('#new-version').getByRole('button', { name: 'Reload' }).click();
    await expect(page.locator('html')).toHaveAttribute('data-build', 'next', { timeout: 60_000 });
    await isReady(page);
    await expect(page.locator('#new-version')).toBeHidden();
  } finally {
    await host.close();
    rmSync(folder, { recursive: true });
  }
});
