/** Accessibility: axe finds nothing in light and dark, in any step; windows of all sizes; the keyboard. */
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { openDemo, openStep, runMap } from './page.ts';

const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

type Scheme = 'light' | 'dark';

async function expectNoFindings(page: Page, where: string, schemes: readonly Scheme[] = ['dark', 'light']): Promise<void> {
  for (const colorScheme of schemes) {
    await page.emulateMedia({ colorScheme });
    const axe = new AxeBuilder({ page });
    // The colour scheme changes only colours, so in dark only the contrast is checked.
    const { violations } = await (colorScheme === 'dark' ? axe.withRules('color-contrast') : axe.withTags(RULES)).analyze();
    const told = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
    expect(told, `${where}, ${colorScheme}`).toEqual([]);
  }
}

/** Opens the page with a demo and without motion, so that no colour is changing while it is checked. */
async function openStill(page: Page): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await openDemo(page);
}

test('axe finds nothing at the start and with a map, light and dark', async ({ page }) => {
  await openStill(page);
  await openStep(page, 'meshes');
  await expectNoFindings(page, 'meshes, idle');
  await runMap(page);
  await openStep(page, 'map');
  await expectNoFindings(page, 'map, done');
});

test('axe finds nothing in any step, before the map and after it', { tag: '@long' }, async ({ page }) => {
  await openStill(page);
  for (const step of ['landmarks', 'map', 'use', 'method'] as const) {
    await openStep(page, step);
    await expectNoFindings(page, `${step}, idle`, ['light']);
  }
  await openStep(page, 'map');
  await runMap(page);
  await page.locator('#result summary').click();
  await page.locator('#details summary').first().click();
  for (const step of ['map', 'landmarks', 'use', 'method'] as const) {
    await openStep(page, step);
    await expectNoFindings(page, `${step}, done`);
  }
  await page.getByRole('button', { name: /^Picture: / }).click();
  await page.getByRole('radio', { name: 'Distortion' }).check();
  await expectNoFindings(page, 'picture');
  await page.keyboard.press('Escape');
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog')).toBeVisible();
  await expectNoFindings(page, 'help');
});

test('the chosen theme stays over a reload', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'light' });
  await openDemo(page);
  const ground = (): Promise<string> => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.getByRole('button', { name: 'Light or dark' }).click();
  await page.getByRole('button', { name: 'Dark', exact: true }).click();
  const dark = await ground();
  expect(dark).not.toBe(light);
  await page.reload();
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  expect(await ground()).toBe(dark);
});

test('the main action is in sight, and nothing scrolls sideways, from a phone to a large screen', async ({ page }) => {
  for (const [width, height] of [[360, 640], [360, 800], [800, 400], [1280, 800], [2560, 1440]] as const) {
    await page.setViewportSize({ width, height });
    await openDemo(page);
    for (const step of ['landmarks', 'map'] as const) {
      await openStep(page, step);
      await expect(page.locator('#run'), `${width} x ${height}`).toBeInViewport({ ratio: 1 });
    }
    const sizes = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    expect(sizes[0], `${width} x ${height}`).toBe(sizes[1]);
    for (const view of ['#view-source', '#view-target']) {
      const box = await page.locator(view).boundingBox();
      expect(Math.min(box?.width ?? 0, box?.height ?? 0), `${view} at ${width} x ${height}`).toBeGreaterThan(60);
    }
  }
});

/** The controls on the views that are covered at their middle, or stick out of their view. */
async function hidden(page: Page): Promise<string[]> {
  return page.locator('.view-bar, .map-bar, .picture-bar').locator('button, input').evaluateAll((controls) =>
    controls
      .filter((control) => {
        const { left, right, top, bottom } = control.getBoundingClientRect();
        const pane = control.closest('.pane')?.getBoundingClientRect();
        const above = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
        const isInside = pane !== undefined && left >= pane.left && right <= pane.right && top >= pane.top && bottom <= pane.bottom;
        return !isInside || !control.contains(above);
      })
      .map((control) => control.getAttribute('aria-label') ?? control.outerHTML),
  );
}

test('no bar on a view lies over another one, however narrow the views are', async ({ page }) => {
  await openDemo(page, '#demo=sphere-tetrahedron');
  await runMap(page);
  await openStep(page, 'use');
  await page.getByRole('radio', { name: 'Conformal factor' }).check();
  for (const [width, height] of [[1280, 800], [1024, 768], [853, 533], [800, 600], [640, 400]] as const) {
    await page.setViewportSize({ width, height });
    await expect.poll(() => hidden(page), { message: `${width} x ${height}` }).toEqual([]);
  }
});

test('the menu of what the surfaces show stays inside the window', async ({ page }) => {
  await openDemo(page, '#demo=sphere-tetrahedron');
  await page.getByRole('button', { name: /^Picture: / }).click();
  const box = page.locator('.popover > .body');
  for (const [width, height] of [[1280, 800], [640, 400]] as const) {
    await page.setViewportSize({ width, height });
    await expect.poll(async () => {
      const { x, y, width: wide, height: high } = (await box.boundingBox()) ?? { x: -1, y: -1, width: 0, height: 0 };
      return wide > 0 && x >= 0 && y >= 0 && x + wide <= width && y + high <= height;
    }, `${width} x ${height}`).toBe(true);
  }
  for (const name of ['Plain', 'Distortion', 'Texture boundary']) {
    const choice = page.getByLabel(name, { exact: true }).last();
    await choice.scrollIntoViewIfNeeded();
    await expect(choice, name).toBeInViewport({ ratio: 1 });
  }
});

test('a phone shows the whole hint and the whole main action', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 780 });
  await openDemo(page);
  await expect(page.locator('#hint')).toContainText('make the map');
  const lacks = await page.locator('#hint').evaluate((hint) => [hint.scrollWidth - hint.clientWidth, hint.scrollHeight - hint.clientHeight]);
  expect(lacks).toEqual([0, 0]);
  await page.setViewportSize({ width: 360, height: 640 });
  for (const step of ['meshes', 'landmarks', 'map', 'use', 'method'] as const) {
    await openStep(page, step);
    expect(await page.locator('#run > span').evaluate((words) => words.scrollWidth - words.clientWidth), step).toBe(0);
  }
});

test('what a box or a dialog holds ends before its border', async ({ page }) => {
  await openDemo(page, '#demo=sphere-tetrahedron');
  const sticksOut = (selector: string): Promise<number[]> =>
    page.locator(selector).evaluateAll((boxes) => boxes.map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth));
  for (const [width, height] of [[1280, 800], [640, 400], [320, 568]] as const) {
    await page.setViewportSize({ width, height });
    await page.getByRole('button', { name: 'Share', exact: true }).click();
    await expect(page.locator('#copy-link')).toBeVisible();
    expect(await sticksOut('.popover > .body'), `Share at ${width}`).toEqual([0]);
    await page.keyboard.press('Escape');
    await page.keyboard.press('?');
    await expect(page.getByRole('dialog')).toBeVisible();
    expect(await sticksOut('dialog[open]'), `help at ${width}`).toEqual([0]);
    await page.keyboard.press('Escape');
  }
});

test('the keyboard goes on beside what it has removed', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const press = async (name: string): Promise<void> => {
    await page.getByRole('button', { name, exact: true }).press('Enter');
  };
  await press('Delete pair 4');
  await expect(page.getByRole('button', { name: 'Delete pair 5', exact: true })).toBeFocused();
  await press('Clear all');
  await expect(page.locator('#panel-title')).toBeFocused();
  await openStep(page, 'meshes');
  await page.locator('[data-demo-id="sphere-tetrahedron"]').first().press('Enter');
  await expect(page.locator('#panel h2')).toContainText('Map', { timeout: 60_000 });
  await expect(page.locator('#panel-title')).toBeFocused();
});

test('steps open by keys, and their panel folds away', async ({ page }) => {
  await openDemo(page);
  const names = ['Meshes', 'Landmarks', 'Map', 'Use', 'Method'];
  await page.locator('body').press('1');
  for (const [index, name] of names.entries()) {
    if (index > 0) {
      await page.keyboard.press(String(index + 1));
    }
    await expect(page.locator('#panel h2').first()).toContainText(name);
  }
  const wide = (await page.locator('#stage').boundingBox())?.width ?? 0;
  await page.keyboard.press('5');
  await expect(page.locator('#panel')).toBeHidden();
  expect((await page.locator('#stage').boundingBox())?.width).toBeGreaterThan(wide + 300);
  await page.keyboard.press('3');
  await expect(page.locator('#run')).toBeVisible();
});

test('the divider shares the width by drag, keys and double-click', async ({ page }) => {
  await openDemo(page);
  const share = async (): Promise<number> => {
    const [view, stage] = [await page.locator('#view-source').boundingBox(), await page.locator('#stage').boundingBox()];
    return (view?.width ?? 0) / (stage?.width ?? 1);
  };
  const divider = page.getByRole('separator');
  const box = await divider.boundingBox();
  const stage = await page.locator('#stage').boundingBox();
  expect(box !== null && stage !== null).toBe(true);
  if (box !== null && stage !== null) {
    await page.mouse.move(box.x + box.width / 2, box.y + 30);
    await page.mouse.down();
    await page.mouse.move(stage.x + 0.3 * stage.width, box.y + 60, { steps: 5 });
    await page.mouse.up();
  }
  expect(await share()).toBeCloseTo(0.3, 1);
  await divider.press('ArrowRight');
  expect(await share()).toBeCloseTo(0.35, 1);
  await divider.press('End');
  expect(await share()).toBeCloseTo(1, 2);
  await divider.dblclick({ position: { x: 6, y: 40 } });
  expect(await share()).toBeCloseTo(0.5, 2);
  await page.getByRole('button', { name: 'Show the target alone' }).click();
  await expect(page.locator('#view-source')).toBeHidden();
  await page.getByRole('button', { name: 'Show both views' }).click();
  await expect(page.locator('#view-source')).toBeVisible();
});
