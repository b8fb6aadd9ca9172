/** The guide, the plots and the gallery as a user sees them. */
import { readFileSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import type { Download, Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { finished, open, openDemo, openStep, ROOT, runMap } from './page.ts';

const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

async function expectNoFindings(page: Page, where: string): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).withTags(RULES).analyze();
  const told = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
  expect(told, where).toEqual([]);
}

/** The errors that the console reports from now on. */
function errorsOf(page: Page): readonly string[] {
  const errors: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error') {
      errors.push(message.text());
    }
  });
  page.on('pageerror', (error) => {
    errors.push(error.message);
  });
  return errors;
}

/** Checks that at these widths no part of an open dialog is wider than the dialog. */
async function expectFits(page: Page, id: string): Promise<void> {
  for (const width of [360, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    await expect
      .poll(() => page.locator(`#${id} > .inside`).evaluate((inside) => inside.scrollWidth - inside.clientWidth), { message: `${id} at ${width}` })
      .toBe(0);
    const wide = await page
      .locator(`#${id} .equation`)
      .evaluateAll((equations) => equations.filter((e) => e.scrollWidth > e.clientWidth).map((e) => e.textContent));
    expect(wide, `equations at ${width}`).toEqual([]);
  }
}

test('the guide opens by its link, draws its equations, and closes by Escape', async ({ page }) => {
  const errors = errorsOf(page);
  await open(page, '#guide=method');
  const guide = page.getByRole('dialog', { name: 'Guide' });
  await expect(guide.getByRole('heading', { name: 'The method in ten steps' })).toBeFocused();
  await expect(page).not.toHaveURL(/guide/);
  const equations = guide.locator('.equation math');
  await expect(equations).toHaveCount(10);
  const heights = await equations.evaluateAll((all) => all.map((math) => math.getBoundingClientRect().height));
  expect(Math.min(...heights)).toBeGreaterThan(12);
  await expect(guide.locator('svg.drawing')).toHaveCount(11);

  // A drawing follows its slider.
  const corner = guide.getByRole('slider', { name: 'Corner' });
  await corner.fill('76');
  await expect(guide.getByRole('img', { name: /the edge stays/ })).toBeVisible();
  await corner.fill('12');
  await expect(guide.getByRole('img', { name: /α \+ β = \d+°: flipped/ })).toBeVisible();

  await guide.getByRole('link', { name: 'What the numbers mean' }).click();
  await expect(guide.getByRole('heading', { name: 'What the numbers mean' })).toBeFocused();
  await expectFits(page, 'guide');
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    await expectNoFindings(page, `the guide, ${colorScheme}`);
  }
  await page.keyboard.press('Escape');
  await expect(guide).toBeHidden();

  await page.locator('#open-guide').click();
  await expect(guide.getByRole('heading', { name: 'What Conemap does' })).toBeVisible();
  // Keys do not reach the page beneath meanwhile.
  await page.keyboard.press('4');
  await guide.getByRole('button', { name: 'Close: Guide' }).click();
  await expect(guide).toBeHidden();
  await expect(page.locator('#step-use')).not.toHaveAttribute('aria-current', 'step');
  await openStep(page, 'method');
  await page.locator('#read-guide').click();
  await expect(guide.getByRole('heading', { name: 'The method in ten steps' })).toBeFocused();
  expect(errors).toEqual([]);
});

test('a guide that cannot be fetched says so, and comes when it can', { tag: '@long' }, async ({ page }) => {
  await openDemo(page);
  const chunk = /assets\/guide-[\w-]+\.js/;
  await page.route(chunk, (route) => route.abort());
  await page.locator('#open-guide').click();
  const guide = page.getByRole('dialog', { name: 'Guide' });
  await expect(guide.getByRole('alert')).toContainText('could not be fetched');
  await expect(page.locator('#error')).toBeHidden();
  const again = guide.getByRole('button', { name: 'Try again' });
  const refused = page.waitForEvent('requestfailed', (request) => chunk.test(request.url()));
  await again.click();
  await refused;
  await expect(guide.getByRole('alert')).toContainText('could not be fetched');
  await page.unroute(chunk);
  await again.click();
  await expect(guide.getByRole('heading', { name: 'What Conemap does' })).toBeVisible();
});

async function saved(page: Page, plot: string, format: string): Promise<Buffer> {
  const download = page.waitForEvent('download');
  await page.locator(`[data-plot="${plot}"]`).getByRole('button', { name: new RegExp(`as ${format}$`) }).click();
  const file: Download = await download;
  expect(file.suggestedFilename()).toBe(`conemap-${plot}.${format.toLowerCase()}`);
  return readFileSync(await file.path());
}

test('a map is plotted, read by keys, saved, and compared with the one before it', { tag: '@long' }, async ({ page }) => {
  const errors = errorsOf(page);
  await openDemo(page, '#demo=sphere-tetrahedron');
  await runMap(page);
  await openStep(page, 'method');
  await page.getByRole('button', { name: 'Plots…' }).click();
  const plots = page.getByRole('dialog', { name: 'Plots' });
  await expect(plots.locator('canvas')).toHaveCount(2);
  await expect(plots).toContainText(/Newton steps, \d+ iterations of conjugate gradients/);
  await expect(plots).toContainText('Mean 1.');

  const residuals = plots.getByRole('img', { name: /^Convergence/ });
  await residuals.press('Home');
  await expect(plots.getByRole('status').filter({ hasText: /^Newton step 0\. Largest curvature error \(rad\): Source [\d.]+, Target [\d.]+$/ })).toBeVisible();
  await residuals.press('ArrowRight');
  await expect(plots.getByRole('status').filter({ hasText: /^Newton step 1\. / })).toBeVisible();

  const table = (await saved(page, 'residuals', 'CSV')).toString();
  expect(table.split('\n')[0]).toBe('Newton step,Source,Target');
  expect(Number(table.split('\n')[1]?.split(',')[1])).toBeGreaterThan(1e-3);
  const svg = (await saved(page, 'residuals', 'SVG')).toString();
  expect(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelectorAll('parsererror').length, svg)).toBe(0);
  expect(svg).toContain('Largest curvature error (rad)');
  const png = await saved(page, 'density-histogram', 'PNG');
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual([1440, 880]);
  expect(png.length).toBeGreaterThan(10_000);

  await plots.getByRole('radio', { name: 'Cumulative' }).check();
  await plots.getByRole('radio', { name: 'Area' }).check();
  const area = (await saved(page, 'area-cumulative', 'CSV')).toString().trim().split('\n');
  expect(Number(area.at(-1)?.split(',')[1])).toBeGreaterThan(99);
  await expectFits(page, 'plots');
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    await expectNoFindings(page, `the plots, ${colorScheme}`);
  }
  await page.keyboard.press('Escape');
  await expect(plots).toBeHidden();

  // The guide shows the numbers of the map, and the map itself on demand.
  await page.locator('#open-guide').click();
  await expect(page.locator('#guide')).toContainText(/Here E = 4\.\d+/);
  await page.locator('#guide li', { hasText: 'Relax the map itself' }).getByRole('button', { name: 'Show it on the meshes' }).click();
  await expect(page.getByRole('button', { name: 'Picture: Distortion' })).toBeVisible();

  // Another map is made; the plots keep the one before it.
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Delete pair 1', exact: true }).click();
  await page.locator('#run').click();
  await expect(page.locator('body')).toHaveAttribute('data-state', 'running');
  await finished(page);
  await openStep(page, 'method');
  await page.getByRole('button', { name: 'Plots…' }).click();
  await expect(plots.locator('.key .before')).toHaveText(['Before', 'Source before', 'Target before']);
  await expect(plots).toContainText('Before, faint: sphere-tetrahedron-source and sphere-tetrahedron-target');
  expect(errors).toEqual([]);
});

test('the gallery shows each demo with its picture, and copies its link', { tag: '@long' }, async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await openDemo(page);
  await openStep(page, 'meshes');
  const pictures = page.locator('.demo-card img');
  expect(await pictures.count()).toBeGreaterThanOrEqual(3);
  for (const picture of await pictures.all()) {
    await picture.scrollIntoViewIfNeeded();
    await expect.poll(() => picture.evaluate((image: HTMLImageElement) => image.naturalWidth)).toBe(480);
  }
  await page.getByRole('button', { name: 'Copy the link to the demo “Two poses”' }).click();
  await expect(page.locator('.toast')).toContainText('The link is copied.');
  expect(new URL(await page.evaluate(() => navigator.clipboard.readText())).hash).toBe('#demo=poses');

  // An empty page shows the same pictures; a link that waits for its click leaves the page empty.
  await page.goto('about:blank');
  await open(page, '#source=https://example.org/a.obj');
  expect(await page.locator('.demo-line .demo-card').count()).toBeGreaterThanOrEqual(3);
  await expect(page.locator('.demo-line img').first()).toBeInViewport({ ratio: 1 });
  await expectNoFindings(page, 'the invitation');
  await page.screenshot({ path: `${ROOT}test-results/invitation.png` });
});
