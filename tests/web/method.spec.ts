/**
 * The step Method: the base domain is turned with the views, asked about its parts, lit up on the meshes and from them, and saved; the flat
 * metrics in the plane are grown from patches; flows and simplification are played on the meshes.
 */
import { readFileSync } from 'node:fs';
import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Spot } from './canvas.ts';
import { countPixels, pixelsOf, seen, SETTLED } from './canvas.ts';
import { fail, openDemo, openStep, ROOT, runMap } from './page.ts';

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
  // The details of the map have a link to the base domain.
  await openStep(page, 'map');
  await page.getByText('Details', { exact: true }).click();
  await page.locator('#show-base-domain').click();
  await expect(page.locator('#base-picture circle').first()).toBeVisible();
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
});

test.afterAll(async () => {
  await page.context().close();
});

/**
 * The number of pixels of a view in the colour in which parts are lit up: magenta, over whatever is beneath. Some pins have this colour,
 * too.
 */
async function litPixels(view: string): Promise<number> {
  return countPixels(await pixelsOf(page, view), (r, g, b) => r > g + 60 && b > g + 30);
}

async function lit(): Promise<readonly number[]> {
  await page.waitForTimeout(200);
  return [await litPixels('#view-source'), await litPixels('#view-target')];
}

/** The places of the corners in the picture, in the order of their numbers. */
async function corners(): Promise<Spot[]> {
  return page.locator('#base-picture circle').evaluateAll((circles) =>
    circles
      .map((circle) => ({ cone: Number(circle.getAttribute('data-cone')), x: Number(circle.getAttribute('cx')), y: Number(circle.getAttribute('cy')) }))
      .sort((a, b) => a.cone - b.cone),
  );
}

test('it has the corners, sides and triangles of the map, and their curvatures sum to two full turns', async () => {
  const text = (await page.locator('.base-reading').textContent()) ?? '';
  const [, vertices = '', sides = '', triangles = ''] = /^(\d+) corners, (\d+) sides, (\d+) triangles/.exec(text) ?? fail(text);
  // Euler's formula.
  expect(Number(triangles)).toBe(2 * Number(vertices) - 4);
  expect(Number(sides)).toBe(3 * Number(vertices) - 6);
  expect(text).toContain('sum to +720.0°');
  expect(await page.locator('#base-picture circle').count()).toBe(Number(vertices));
  const signs = await page.locator('#base-picture circle').evaluateAll((all) => all.map((circle) => circle.classList.contains('positive')));
  expect(signs).toContain(true);
  expect(signs).toContain(false);
  await page.screenshot({ path: `${ROOT}test-results/base-domain.png` });
});

test('it turns with the views, and they with it', async () => {
  const before = await corners();
  await page.locator('#view-target').focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(SETTLED);
  const turned = await corners();
  expect(Math.max(...turned.map((spot, k) => Math.hypot(spot.x - (before[k]?.x ?? 0), spot.y - (before[k]?.y ?? 0))))).toBeGreaterThan(5);

  // A drag on the picture turns the pins in the target's view.
  const heads = (): Promise<string[]> => page.locator('#view-target .labels span').evaluateAll((all) => all.map((span) => (span as HTMLElement).style.transform + (span as HTMLElement).style.cssText));
  const pins = await heads();
  const box = (await page.locator('#base-picture').boundingBox()) ?? fail('no picture');
  await page.mouse.move(box.x + 20, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 80, box.y + 30, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  expect(await heads()).not.toEqual(pins);
  expect(await corners()).not.toEqual(turned);
});

test('a corner, a side and a triangle light up on both meshes', async () => {
  const before = await lit();
  await page.locator('#base-picture').focus();
  await page.keyboard.press('v');
  await expect(page.locator('.base-reading')).toContainText(/Corner .*: curvature [+−]\d+\.\d°/);
  await expect(page.locator('#base-picture .tag')).toContainText(/[+−]\d+\.\d°/);
  await page.keyboard.press('e');
  await expect(page.locator('.base-reading')).toContainText(/^Side from /);
  await page.keyboard.press('f');
  await expect(page.locator('.base-reading')).toContainText(/^Triangle of /);
  // Some patch is visible in both views, and shows many more pixels than a path.
  const seen: (readonly number[])[] = [];
  const isSeen = (counts: readonly number[]): boolean => counts.every((count, side) => count > 300 + (before[side] ?? 0));
  for (let k = 0; k < 8 && !seen.some(isSeen); k += 1) {
    await page.keyboard.press('f');
    seen.push(await lit());
  }
  expect(seen.some(isSeen)).toBe(true);
  await page.screenshot({ path: `${ROOT}test-results/base-domain-lit.png` });
  await page.keyboard.press('Escape');
  expect(await lit()).toEqual(before);
});

test('the patch under the mouse on a mesh lights up in it', async () => {
  const before = await lit();
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no view');
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await expect(page.locator('.base-reading')).toContainText(/^Triangle of /);
  const counts = await lit();
  expect(counts.some((count, side) => count > 100 + (before[side] ?? 0))).toBe(true);
  await page.mouse.move(5, 5);
  await expect(page.locator('.base-reading')).toContainText(/corners, /);
  expect(await lit()).toEqual(before);
});

test('it is saved as a drawing that stands alone', async () => {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the base domain as SVG' }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe('conemap-base-domain.svg');
  const svg = readFileSync(await file.path()).toString();
  expect(svg).toMatch(/^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg" width="900"/);
  expect((svg.match(/<circle/g) ?? []).length).toBeGreaterThan(5);
  expect((svg.match(/<path/g) ?? []).length).toBeGreaterThan(50);

  const second = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the base domain as PNG' }).click();
  const png = readFileSync(await (await second).path());
  expect(png.subarray(1, 4).toString()).toBe('PNG');
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual([1800, 1400]);
});

/** The numbers of pixels of a picture that are red like the cut, or blue-green like the circles. */
async function marked(picture: string): Promise<{ readonly cut: number; readonly circles: number }> {
  await page.locator(picture).scrollIntoViewIfNeeded();
  const pixels = await pixelsOf(page, picture);
  return {
    cut: countPixels(pixels, (r, g, b) => r > 170 && g < 90 && b < 90),
    circles: countPixels(pixels, (r, g, b) => b > r + 20 && g > r + 10),
  };
}

const SOURCE_PLANE = '[data-plane="0"]';
const TARGET_PLANE = '[data-plane="1"]';

/** Saves the layout in the plane as a file. */
async function savedPlane(format: string): Promise<Buffer> {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: `Save the plane as ${format}` }).click();
  return readFileSync(await (await download).path());
}

test('both meshes are laid out in the plane, cut from cone to cone', async () => {
  await page.locator('#open-plane').click();
  await expect(page.locator(SOURCE_PLANE)).toHaveAttribute('data-drawn', '5114', { timeout: 120_000 });
  await expect(page.locator(TARGET_PLANE)).toHaveAttribute('data-drawn', '4574');
  await page.locator(SOURCE_PLANE).scrollIntoViewIfNeeded();
  await page.screenshot({ path: `${ROOT}test-results/plane.png` });
  const whole = [await marked(SOURCE_PLANE), await marked(TARGET_PLANE)];
  for (const { cut } of whole) {
    expect(cut).toBeGreaterThan(100);
  }
  // A few rings around the seed need no cut.
  const slider = page.getByRole('slider', { name: 'Step of the growth' });
  await slider.focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await expect(page.locator(SOURCE_PLANE)).toHaveAttribute('data-drawn', '1');
  await page.waitForTimeout(200);
  expect((await marked(SOURCE_PLANE)).cut).toBeLessThan(20 + (whole[0]?.cut ?? 0) / 4);
  await page.keyboard.press('End');
  await expect(page.locator(SOURCE_PLANE)).toHaveAttribute('data-drawn', '5114');
});

test('the layout grows from the patch that is chosen in the base domain or in the plane', { tag: '@long' }, async () => {
  await page.locator('#base-picture').focus();
  await page.keyboard.press('f');
  await page.keyboard.press('f');
  await expect(page.locator('.base-reading')).toContainText(/^Triangle of /);
  await expect(page.locator('#play-growth')).toHaveText('Pause');
  await expect(page.locator('#play-growth')).toHaveText('Play', { timeout: 60_000 });
  await expect(page.locator(SOURCE_PLANE)).toHaveAttribute('data-drawn', '5114');
  // The patch is lit up in the plane as well.
  await page.locator(SOURCE_PLANE).scrollIntoViewIfNeeded();
  await page.waitForTimeout(200);
  expect(await litPixels(SOURCE_PLANE)).toBeGreaterThan(20);
  const reading = await page.locator('.base-reading').textContent();

  // A click grows the layout from another patch.
  await page.locator(TARGET_PLANE).scrollIntoViewIfNeeded();
  const box = (await page.locator(TARGET_PLANE).boundingBox()) ?? fail('no plane');
  const shares = Array.from({ length: 12 }, (_, k) => 0.08 + 0.07 * k);
  const places = shares.flatMap((x) => shares.map((y) => ({ x: box.x + x * box.width, y: box.y + y * box.height })));
  let isOverAnother = false;
  for (const { x, y } of places) {
    await page.mouse.move(x, y);
    await page.waitForTimeout(60);
    const now = await page.locator('.base-reading').textContent();
    isOverAnother = now?.startsWith('Triangle of ') === true && now !== reading;
    if (isOverAnother) {
      await page.mouse.click(x, y);
      break;
    }
  }
  expect(isOverAnother).toBe(true);
  await expect(page.locator('#play-growth')).toHaveText('Pause');
  await page.waitForTimeout(1500);
  await page.screenshot({ path: `${ROOT}test-results/plane-growing.png` });
  await expect(page.locator('#play-growth')).toHaveText('Play', { timeout: 60_000 });
  await page.mouse.move(5, 5);
});

test('the plane shows the circles of the packing, and is saved as picture, drawing and mesh', async () => {
  await page.waitForTimeout(300);
  const without = await marked(SOURCE_PLANE);
  await page.getByRole('checkbox', { name: 'Circles of the packing' }).check();
  await page.waitForTimeout(500);
  expect((await marked(SOURCE_PLANE)).circles).toBeGreaterThan(without.circles + 200);
  await page.screenshot({ path: `${ROOT}test-results/plane-circles.png` });
  const svg = (await savedPlane('SVG')).toString();
  expect(svg).toMatch(/^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg" width="900"/);
  expect((svg.match(/<circle/g) ?? []).length).toBeGreaterThan(1000);
  expect(svg).toMatch(/id="cut" d="M/);
  const png = await savedPlane('PNG');
  expect([png.readUInt32BE(16), png.readUInt32BE(20)]).toEqual([1800, 1400]);
  expect((await savedPlane('OBJ')).toString().match(/^f /gm)?.length).toBe(4574);
  await page.locator(SOURCE_PLANE).focus();
  const small = await marked(SOURCE_PLANE);
  await page.keyboard.press('+');
  await page.keyboard.press('+');
  await page.waitForTimeout(400);
  expect(await marked(SOURCE_PLANE)).not.toEqual(small);
  await page.keyboard.press('0');
  await page.keyboard.press('Escape');
  await page.waitForTimeout(400);
  await expect(page.locator('.base-reading')).toContainText(/corners, /);
});

/** The numbers of pixels of a view that are warm or violet, where factors grow or shrink. */
async function coloured(view: string): Promise<{ readonly warm: number; readonly violet: number }> {
  const pixels = await pixelsOf(page, view);
  return {
    warm: countPixels(pixels, (r, g, b) => r > g + 25 && g > b + 25),
    violet: countPixels(pixels, (r, g, b) => b > g + 25 && r > g),
  };
}

test('the flow is played on both meshes, its error falls, and the picture comes back', async () => {
  const before = await page.screenshot({ clip: (await page.locator('#view-source').boundingBox()) ?? fail('no view') });
  await page.locator('#watch-flow').click();
  const slider = page.getByRole('slider', { name: 'Step of the flow' });
  await expect(slider).toBeVisible();
  const error = async (side: number): Promise<number> => {
    const text = (await page.locator(`[data-flow="${side}"] td`).nth(1).textContent()) ?? '';
    const digits = text.replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)));
    return Number(digits.replace(/·10⁻/, 'e-'));
  };
  const first = [await error(0), await error(1)];
  // Before the first step every factor is 1.
  await page.waitForTimeout(300);
  const start = await coloured('#view-target');
  await page.locator('#play-flow').click();
  await expect(page.locator('#play-flow')).toHaveText('Play', { timeout: 60_000 });
  expect(await slider.inputValue()).toBe(await slider.getAttribute('max'));
  const last = [await error(0), await error(1)];
  for (const side of [0, 1]) {
    expect(first[side]).toBeGreaterThan(0.01);
    expect(last[side]).toBeLessThan(1e-8);
  }
  await page.waitForTimeout(300);
  for (const view of ['#view-source', '#view-target']) {
    const end = await coloured(view);
    expect(end.warm).toBeGreaterThan(start.warm + 300);
    expect(end.violet).toBeGreaterThan(start.violet + 300);
  }
  await slider.scrollIntoViewIfNeeded();
  await page.screenshot({ path: `${ROOT}test-results/flow.png` });
  await slider.focus();
  await page.keyboard.press('Home');
  await expect.poll(() => error(0)).toBe(first[0]);
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the steps of the flows as CSV' }).click();
  const csv = readFileSync(await (await download).path()).toString();
  expect(csv).toMatch(/^mesh,Newton step,/);
  expect(csv.match(/^target,/gm)?.length).toBeGreaterThan(2);
  await page.locator('#close-flow').click();
  await page.waitForTimeout(300);
  const after = await page.screenshot({ clip: (await page.locator('#view-source').boundingBox()) ?? fail('no view') });
  expect(after.equals(before)).toBe(true);
});

test('both meshes are simplified to their landmarks, and come back', { tag: '@long' }, async () => {
  const view = async (): Promise<Buffer> => page.screenshot({ clip: (await page.locator('#view-source').boundingBox()) ?? fail('no view') });
  const before = await view();
  await page.locator('#watch-simplification').click();
  const slider = page.getByRole('slider', { name: 'Step of the simplification' });
  await expect(slider).toBeVisible();
  const words = page.locator('.stage-words');
  await expect(words).toHaveText('5,114 triangles on the source, 4,574 on the target');
  await page.locator('#play-simplification').click();
  await expect(page.locator('#play-simplification')).toHaveText('Play', { timeout: 60_000 });
  // Both meshes have as many triangles: twice the number of vertices, less 4.
  const [, source = '', target = ''] = /^(\d+) triangles on the source, (\d+) on the target$/.exec((await words.textContent()) ?? '') ?? fail('no counts');
  expect(source).toBe(target);
  expect(Number(source)).toBe(2 * (await page.locator('#view-source .labels span').count()) - 4);
  await page.waitForTimeout(300);
  expect((await view()).equals(before)).toBe(false);
  await page.screenshot({ path: `${ROOT}test-results/simplification.png` });
  await slider.focus();
  await page.keyboard.press('Home');
  for (let k = 0; k < 12; k += 1) {
    await page.keyboard.press('ArrowRight');
  }
  await page.waitForTimeout(300);
  await page.screenshot({ path: `${ROOT}test-results/simplification-middle.png` });
  // The vertex under the mouse has a history, which is drawn in red.
  const history = page.locator('.history-words');
  await expect(history).toContainText('Point at a mesh');
  const red = async (): Promise<number> => (await seen(page, 'source')).red;
  const without = await red();
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no view');
  await page.mouse.move(box.x + 0.45 * box.width, box.y + 0.48 * box.height, { steps: 4 });
  await expect(history).toHaveText(/^On the source: merged into its neighbour by collapse [\d,]+ of 2,5\d\d.* On the target: /);
  await expect.poll(red).toBeGreaterThan(without + 0.0003);
  await page.screenshot({ path: `${ROOT}test-results/simplification-history.png` });
  await page.mouse.move(box.x + 3, box.y + 3);
  await expect(history).toContainText('Point at a mesh');
  await expect.poll(red).toBeLessThan(without + 0.0001);
  // With one mesh simplified and carried to the other, both have equally many triangles from the beginning.
  for (const [choice, count] of [['From the target', '4,574'], ['Jointly', '5,114']] as const) {
    await page.getByRole('radio', { name: choice }).check();
    await expect(words).toHaveText(`${count} triangles on the source, ${count} on the target`, { timeout: 60_000 });
    await slider.focus();
    await page.keyboard.press('End');
    // Only the user's landmarks remain.
    await expect(words).toHaveText(/^(\d+) triangles on the source, \1 on the target$/);
    await page.keyboard.press('Home');
    for (let k = 0; k < 14; k += 1) {
      await page.keyboard.press('ArrowRight');
    }
    await page.waitForTimeout(300);
    await page.screenshot({ path: `${ROOT}test-results/simplification-${choice.replaceAll(' ', '-')}.png` });
  }
  await page.locator('#close-simplification').click();
  await page.mouse.move(5, 5);
  await page.waitForTimeout(300);
  expect((await view()).equals(before)).toBe(true);
});

test('where motion is not wanted the flow goes step by step', { tag: '@long' }, async () => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.locator('#watch-flow').click();
  const now = page.locator('.flow-residuals .now');
  await expect(now).toBeAttached();
  const seen = new Set<string>();
  await page.locator('#play-flow').click();
  while ((await page.locator('#play-flow').textContent()) === 'Pause') {
    seen.add((await now.getAttribute('d')) ?? '');
  }
  const steps = Number(await page.getByRole('slider', { name: 'Step of the flow' }).getAttribute('max'));
  expect(seen.size).toBeGreaterThan(1);
  expect(seen.size).toBeLessThanOrEqual(steps + 1);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
});

test('all of it fits a phone and a wide window, light and dark, without findings', { tag: '@long' }, async () => {
  for (const width of [360, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    await openStep(page, 'method');
    const content = page.locator('#panel .content');
    await expect.poll(() => content.evaluate((element) => element.scrollWidth - element.clientWidth), { message: `at ${width}` }).toBe(0);
    for (const colorScheme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme });
      await page.locator('#base-picture').scrollIntoViewIfNeeded();
      await expect(page.locator('.flow-numbers')).toBeAttached();
      await expect(page.locator('.plane-layouts')).toBeAttached();
      const { violations } = await new AxeBuilder({ page }).include('#panel').withTags(RULES).analyze();
      expect(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`)).toEqual([]);
      await page.screenshot({ path: `${ROOT}test-results/base-domain-${width}-${colorScheme}.png` });
      await page.locator(SOURCE_PLANE).scrollIntoViewIfNeeded();
      await page.waitForTimeout(500);
      await page.screenshot({ path: `${ROOT}test-results/plane-${width}-${colorScheme}.png` });
    }
  }
  await page.getByRole('button', { name: 'Large', exact: true }).click();
  expect((await page.locator('#base-picture').boundingBox())?.width).toBeGreaterThan(500);
  await page.waitForTimeout(SETTLED);
  await page.screenshot({ path: `${ROOT}test-results/base-domain-large.png` });
  await page.getByRole('button', { name: 'Large', exact: true }).click();
  expect(errors).toEqual([]);
});
