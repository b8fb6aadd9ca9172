import { readFileSync, writeFileSync } from 'node:fs';
import type { Page } from '@playwright/test';
import { placesOnBody } from './canvas.ts';
import { expect, test } from './test.ts';
import { DATA, drop, fail, needsSharedData, open, openDemo, openStep, pairs, ROOT, RUN_TIMEOUT, runMap, showSurface } from './page.ts';

interface Half {
  readonly colours: number;
  /** The share of the pixels that differ from the half's corner. */
  readonly covered: number;
}

/** Reads both halves of the canvas right after a frame that a small turn has caused. */
async function readHalves(page: Page): Promise<Half[]> {
  return page.evaluate(
    () =>
      new Promise<Half[]>((resolve) => {
        document.querySelector('#view-source')?.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
        document.querySelector('#view-target')?.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
        requestAnimationFrame(() => {
          const canvas = document.querySelector<HTMLCanvasElement>('#canvas');
          if (canvas === null) {
            throw new Error('no canvas');
          }
          const { width, height } = canvas;
          const context = new OffscreenCanvas(width, height).getContext('2d');
          if (context === null) {
            throw new Error('no 2D context');
          }
          context.drawImage(canvas, 0, 0);
          const half = Math.floor(width / 2);
          resolve(
            [0, half].map((left) => {
              const { data } = context.getImageData(left + 2, 2, half - 4, height - 4);
              const pixels = new Uint32Array(data.buffer);
              const corner = pixels[0];
              const others = pixels.filter((pixel) => pixel !== corner);
              return { colours: new Set(others).size, covered: others.length / pixels.length };
            }),
          );
        });
      }),
  );
}

/** Clicks on the body in a view until `picked` is true. A click on a pin would select the pin and pick nothing. */
async function pickOn(page: Page, view: string, picked: () => Promise<boolean>): Promise<void> {
  for (const { x, y } of (await placesOnBody(page, view)).slice(0, 6)) {
    await page.mouse.click(x, y);
    // The page waits whether a click becomes a double click, and a busy machine draws late.
    for (let waited = 0; waited < 3000; waited += 100) {
      if (await picked()) {
        return;
      }
      await page.waitForTimeout(100);
    }
  }
  fail(`no click on ${view} met the mesh`);
}

test.beforeEach(({ page }) => {
  page.on('pageerror', (error) => {
    console.log(`page error: ${error.message}`);
  });
  page.on('console', (message) => {
    if (message.type() === 'error') {
      console.log(`console: ${message.text()}`);
    }
  });
});

test('two real meshes and their landmarks give a certified map', async ({ page }) => {
  needsSharedData();
  await open(page);
  await drop(page, [`${DATA}/shrec07/400.off`, `${DATA}/shrec07/381.off`, `${DATA}/pairs/shrec07-381-400.json`]);
  await expect(page.locator('#view-source')).toContainText('381.off');
  await expect(page.locator('#view-target')).toContainText('400.off');
  await openStep(page, 'landmarks');
  const rows = pairs(page);
  await expect(rows.nth(10)).toBeVisible();
  const count = await rows.count();

  await runMap(page);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: `${ROOT}test-results/real-pair.png` });
  await expect(page.locator('#details')).toContainText(/class(es)? tried/);
  await showSurface(page, 'Distortion');
  await expect(page.locator('.scale')).toBeVisible();
  await page.waitForTimeout(1500);
  await page.screenshot({ path: `${ROOT}test-results/real-pair-distortion.png` });
  for (const half of await readHalves(page)) {
    expect(half.covered).toBeGreaterThan(0.03);
    expect(half.colours).toBeGreaterThan(20);
  }

  const download = page.waitForEvent('download');
  await openStep(page, 'use');
  await page.getByRole('button', { name: 'GLB' }).click();
  expect((await download).suggestedFilename()).toBe('conemap.glb');

  await openStep(page, 'landmarks');
  await pickOn(page, '#view-source', async () => (await page.locator('#landmark-list .pending').count()) === 1);
  await pickOn(page, '#view-target', async () => (await rows.count()) === count + 1);
  await expect(rows).toHaveCount(count + 1);
  await openStep(page, 'map');
  await expect(page.locator('#result')).toContainText(`This map was made before pair ${count + 1} was added.`);
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: `Delete pair ${count + 1}`, exact: true }).click();
  await expect(rows).toHaveCount(count);

  await drop(page, [`${DATA}/bad/open-teapot.off`]);
  const refused = page.locator('.notice.refused');
  await expect(refused).toContainText(/^open-teapot\.off: .*4 separate parts/);
  await expect(refused.getByRole('button', { name: 'Keep the largest part (73 % of the area)' })).toBeEnabled();
  await openStep(page, 'landmarks');
  await expect(rows).toHaveCount(count);
  await openStep(page, 'map');
  await expect(page.locator('#result')).toContainText('Certified');
  await expect(page.locator('#result')).not.toContainText('was made before');
  await refused.getByRole('button', { name: 'Leave it out' }).click();
  await expect(refused).toHaveCount(0);
});

test('pairs that do not fit are named and repaired by a click', async ({ page }) => {
  needsSharedData();
  await open(page);
  const file = JSON.parse(readFileSync(`${DATA}/pairs/cat-lion.json`, 'utf8')) as { pairs: [number, number][]; labels?: string[] };
  const last = file.pairs.length - 1;
  const [a, b] = [file.pairs[0] ?? fail('no pairs'), file.pairs[last] ?? fail('no pairs')];
  const exchanged = file.pairs.map((pair, k) => (k === 0 ? [a[0], b[1]] : k === last ? [b[0], a[1]] : pair));
  const swapped = test.info().outputPath('cat-lion.json');
  writeFileSync(swapped, JSON.stringify({ ...file, pairs: exchanged }));
  await drop(page, [`${DATA}/sumner/lion.off`, `${DATA}/sumner/cat.off`, swapped]);
  await expect(page.locator('body')).toHaveAttribute('data-pairs', String(file.pairs.length));
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(file.pairs.length);
  await page.locator('#run').click();
  await expect(page.locator('#findings')).toContainText('look swapped', { timeout: RUN_TIMEOUT });
  await page.getByRole('button', { name: 'Swap these two pairs' }).first().click();
  await expect(page.locator('#findings')).toBeHidden();
  await expect(page.locator('body')).not.toHaveAttribute('data-state', 'running');
  await openStep(page, 'landmarks');
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save file' }).click();
  const saved = readFileSync(await (await download).path(), 'utf8');
  expect((JSON.parse(saved) as { pairs: unknown }).pairs).toEqual(file.pairs);
});

test('both views are drawn with several samples a pixel', async ({ page }) => {
  // As on a graphics card: the page takes one sample only where it reads the name of a processor.
  await page.addInitScript(() => {
    const { prototype } = WebGL2RenderingContext;
    const told = Reflect.get(prototype, 'getParameter') as (name: number) => unknown;
    Reflect.set(prototype, 'getParameter', function (this: WebGL2RenderingContext, name: number) {
      const value = told.call(this, name);
      return typeof value === 'string' && /swiftshader/i.test(value) ? 'a graphics card' : value;
    });
  });
  await openDemo(page);
  for (const half of await readHalves(page)) {
    expect(half.covered).toBeGreaterThan(0.03);
    expect(half.colours).toBeGreaterThan(20);
  }
});

test('a run can be cancelled and nothing is lost', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const count = await pairs(page).count();
  await page.evaluate(() => {
    document.querySelector<HTMLButtonElement>('#run')?.click();
    document.querySelector<HTMLButtonElement>('#cancel')?.click();
  });
  await expect(page.locator('body')).toHaveAttribute('data-state', 'idle');
  await expect(page.locator('#run')).toBeEnabled();
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(count);
});

test('the views come back after a lost graphics context', async ({ page }) => {
  await openDemo(page);
  const lose = await page.evaluateHandle(() =>
    document.querySelector<HTMLCanvasElement>('#canvas')?.getContext('webgl2')?.getExtension('WEBGL_lose_context'),
  );
  await lose.evaluate((extension) => extension?.loseContext());
  await expect(page.locator('#undrawn')).toContainText('graphics card');
  await page.waitForTimeout(300);
  await lose.evaluate((extension) => extension?.restoreContext());
  await expect(page.locator('#undrawn')).toHaveCount(0);
  await expect(page.locator('#error')).toBeHidden();
  for (const half of await readHalves(page)) {
    expect(half.covered).toBeGreaterThan(0.03);
    expect(half.colours).toBeGreaterThan(20);
  }
});

test('each demo opens by its link; the first one, and those with small meshes, map', { tag: '@long' }, async ({ page }) => {
  test.setTimeout(900_000);
  await openDemo(page, '');
  await openStep(page, 'meshes');
  const ids = await page
    .locator('[data-demo-id]')
    .evaluateAll((buttons) => buttons.map((button) => (button as HTMLButtonElement).dataset['demoId'] ?? ''));
  expect(ids.length).toBeGreaterThanOrEqual(10);
  const mapped = [ids[0], 'horse-cat', 'poses', 'sphere-tetrahedron'];
  for (const id of ids) {
    await page.goto('about:blank');
    await open(page, `#demo=${encodeURIComponent(id)}`);
    await expect(page.locator('body')).toHaveAttribute('data-demo', id, { timeout: 60_000 });
    if (mapped.includes(id)) {
      await runMap(page);
    }
    await page.waitForTimeout(1500);
    await page.screenshot({ path: `${ROOT}test-results/demo-${id}.png` });
    for (const half of await readHalves(page)) {
      expect(half.covered, id).toBeGreaterThan(0.03);
      expect(half.colours, id).toBeGreaterThan(20);
    }
  }
});
