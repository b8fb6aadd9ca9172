/**
 * The comparison of the map on the page with others of the same meshes and landmarks: chosen by one click, shown on the source, with
 * figures.
 */
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { bothDecoded, SETTLED } from './canvas.ts';
import { fail, openDemo, openStep, ROOT, runMap } from './page.ts';
import { trapping } from './trapping.ts';

const RULES = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

test.describe.configure({ mode: 'serial' });

let page: Page;
const errors: string[] = [];

test.beforeAll(async ({ browser }) => {
  page = await (await browser.newContext()).newPage();
  page.on('pageerror', (error) => {
    errors.push(error.message);
  });
  await openDemo(page);
  await runMap(page);
  await page.mouse.move(5, 5);
});

test.afterAll(async () => {
  await page.context().close();
});

/** A picture of a view below its caption, above the bars, and away from the divider. */
async function seen(view: string): Promise<string> {
  const box = (await page.locator(view).boundingBox()) ?? fail(`${view} has no box`);
  const clip = { x: Math.round(box.x) + 10, y: Math.round(box.y) + 48, width: Math.floor(box.width) - 20, height: Math.floor(box.height) - 112 };
  return (await page.screenshot({ clip })).toString('base64');
}

async function views(): Promise<readonly [string, string]> {
  await page.mouse.move(5, 5);
  // A view with the keyboard focus has a frame around it.
  await page.evaluate(() => {
    if (document.activeElement instanceof HTMLElement) {
      document.activeElement.blur();
    }
  });
  await page.waitForTimeout(SETTLED);
  return [await seen('#view-source'), await seen('#view-target')];
}

/**
 * For two pictures of one size: the share of pixels with different colours, the share at which only one picture shows the body, and the
 * number that are grey only in the second.
 */
async function difference([left, right]: readonly [string, string]): Promise<{ readonly colours: number; readonly outline: number; readonly grey: number }> {
  const [{ pixels: a }, { pixels: b }] = await bothDecoded(page, left, right);
  const isGround = (data: Uint8Array, at: number): boolean => [0, 1, 2].every((k) => Math.abs((data[at + k] ?? 0) - (data[k] ?? 0)) < 6);
  const isGrey = (data: Uint8Array, at: number): boolean => {
    const [r = 0, g = 0, b = 0] = data.subarray(at, at + 3);
    return Math.abs(r - g) < 8 && Math.abs(g - b) < 12 && b > 50 && b < 200;
  };
  let [colours, outline, grey] = [0, 0, 0];
  for (let at = 0; at < a.length; at += 4) {
    colours += [0, 1, 2].some((k) => Math.abs((a[at + k] ?? 0) - (b[at + k] ?? 0)) > 40) ? 1 : 0;
    outline += isGround(a, at) === isGround(b, at) ? 0 : 1;
    grey += isGrey(b, at) && !isGrey(a, at) ? 1 : 0;
  }
  return { colours: (4 * colours) / a.length, outline: (4 * outline) / a.length, grey };
}

/** The figures in the table, this map's and the other one's, by their names. */
async function figures(): Promise<ReadonlyMap<string, readonly [string, string]>> {
  const rows = page.locator('.compared-figures tbody tr');
  const texts = await rows.evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
  return new Map(texts.map(([name = '', here = '', there = '']) => [name, [here, there]]));
}

/** Chooses another map, and waits for it. */
async function compareWith(choice: string): Promise<ReadonlyMap<string, readonly [string, string]>> {
  await page.getByRole('radio', { name: choice, exact: true }).check();
  await expect(page.locator('.compared-figures thead')).toContainText(choice, { timeout: 200_000 });
  return figures();
}

const CHOICES = [
  ['Before relaxation', 'before relaxation'],
  ['Equal cones', 'equal cones'],
  ['Patchwise', 'patch by patch'],
  ['Patchwise Tutte', 'patchwise Tutte'],
] as const;

let before: readonly [string, string];

test('each of four maps is shown beside the map on the page by one click in the step Method', async () => {
  before = await views();
  await openStep(page, 'method');
  for (const [choice, caption] of CHOICES) {
    const told = await compareWith(choice);
    const both = await views();
    await page.screenshot({ path: `${ROOT}test-results/compare-${choice.replaceAll(' ', '-')}.png` });
    // Both views show the same body in different colours.
    const { colours, outline } = await difference(both);
    expect(outline, choice).toBeLessThan(0.02);
    expect(colours, choice).toBeGreaterThan(0.01);
    expect(both[0], choice).toBe(before[0]);
    await expect(page.locator('#view-source .caption')).toContainText('this map');
    await expect(page.locator('#view-target .caption')).toContainText('Source');
    await expect(page.locator('#view-target .caption')).toContainText(caption);
    await expect(page.locator('#view-target')).toHaveAttribute('aria-label', /^Second source view\./);
    const [here, there] = told.get('Energy E') ?? fail('no energy');
    expect(Number(here), choice).toBeGreaterThan(4);
    expect(Number(there), choice).toBeGreaterThan(Number(here));
    expect(told.get('Converged'), choice).toEqual(['yes', 'yes']);
    expect(told.get('Newton steps')?.[1], choice).toMatch(/^\d+, \d+$/);
    expect(told.get('Mapped')?.[0], choice).toBe('100.00 %');
    if (['before relaxation', 'patchwise Tutte'].includes(caption)) {
      expect(told.get('Mapped')?.[1], choice).toBe('100.00 %');
    }
  }
});

test('the second view takes no clicks, and Escape, None, the button on it and another step bring the target back', { tag: '@long' }, async () => {
  const box = (await page.locator('#view-target').boundingBox()) ?? fail('no view');
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(SETTLED);
  await expect(page.locator('#undo')).toBeDisabled();
  const ways: readonly (() => Promise<void>)[] = [
    () => page.keyboard.press('Escape'),
    () => page.getByRole('radio', { name: 'None' }).check(),
    () => page.getByRole('button', { name: 'Back to the target' }).click(),
    async () => {
      await openStep(page, 'map');
      await openStep(page, 'method');
    },
  ];
  for (const [number, leave] of ways.entries()) {
    await compareWith('Patchwise');
    await leave();
    await expect(page.locator('#view-target .caption')).toContainText('Target', { timeout: 5000 });
    await expect(page.locator('#view-target')).toHaveAttribute('aria-label', /^Target view\./);
    await expect(page.getByRole('radio', { name: 'None' })).toBeChecked();
    expect((await views())[1] === before[1], `way ${number}`).toBe(true);
  }
});

test('both views turn together, also where the cameras go by themselves, and what the patchwise map leaves out is grey', async () => {
  const told = await compareWith('Patchwise');
  expect(Number.parseFloat(told.get('Mapped')?.[1] ?? '')).toBeLessThan(100);
  await page.getByRole('button', { name: 'Link the cameras' }).click();
  await page.getByRole('button', { name: 'Each by itself' }).click();
  await page.getByRole('button', { name: /^Picture: / }).click();
  await page.getByRole('radio', { name: 'Colours', exact: true }).check();
  await page.keyboard.press('Escape');
  await page.locator('#panel').getByLabel('Landmarks').uncheck();
  const first = await views();
  await page.locator('#view-target').focus();
  await page.keyboard.press('Shift+U');
  const both = await views();
  expect(both[0]).not.toBe(first[0]);
  const { outline, grey } = await difference(both);
  await page.screenshot({ path: `${ROOT}test-results/compare-grey.png` });
  expect(outline).toBeLessThan(0.0005);
  expect(grey).toBeGreaterThan(20);
});

test('no view cuts off the name of its map, however narrow it is', async () => {
  await openStep(page, 'method');
  await compareWith('Before relaxation');
  for (const width of [1024, 853, 375]) {
    await page.setViewportSize({ width, height: 800 });
    for (const view of ['#view-source', '#view-target']) {
      const beyond = (): Promise<number> =>
        page.locator(`${view} .coarse-map`).evaluate((mark) => {
          const edge = mark.closest('.caption')?.getBoundingClientRect().right ?? 0;
          return Math.max(0, mark.getBoundingClientRect().right - edge, mark.scrollWidth - mark.clientWidth);
        });
      await expect.poll(beyond, { message: `${view} at ${width}` }).toBeLessThan(1);
    }
  }
});

test('it fits a phone and a wide window, light and dark, without findings', { tag: '@long' }, async () => {
  for (const width of [360, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    const content = page.locator('#panel .content');
    await expect.poll(() => content.evaluate((element) => element.scrollWidth - element.clientWidth), { message: `at ${width}` }).toBe(0);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await page.locator('#compare').scrollIntoViewIfNeeded();
      await page.waitForTimeout(300);
      const { violations } = await new AxeBuilder({ page }).include('#compare').include('#stage').withTags(RULES).analyze();
      expect(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`)).toEqual([]);
      await page.screenshot({ path: `${ROOT}test-results/compare-${width}-${colorScheme}.png` });
    }
  }
  expect(errors).toEqual([]);
});

test('a map that cannot be made is a sentence in the section, and the map on the page stays', { tag: '@long' }, async ({ page }) => {
  await page.route(/\/core_bg-[^/]*\.wasm$/u, async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: trapping(await response.body(), 'runOtherMap') });
  });
  await openDemo(page);
  await runMap(page);
  await openStep(page, 'method');
  await page.getByRole('radio', { name: 'Patchwise', exact: true }).check();
  await expect(page.locator('#compare')).toContainText('There is no such map of these meshes. The computation stopped unexpectedly', { timeout: 60_000 });
  await expect(page.locator('#error')).toBeHidden();
  await expect(page.locator('#view-target .caption')).toContainText('Target');
  await openStep(page, 'map');
  await expect(page.locator('#result')).toContainText('Certified bijective');
});
