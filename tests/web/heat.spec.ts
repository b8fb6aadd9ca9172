/** Surfaces that belong to the flat metric: textures, also from a picture of the user, and heat maps with their values under the mouse. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { countPixels, halvesPicture, pixelsOf, seen } from './canvas.ts';
import { fail, openDemo, openStep, runMap, showSurface } from './page.ts';

const VIEWS = ['source', 'target'] as const;

/** The share of a view's pixels for which `isSo` is true. */
async function share(page: Page, view: string, isSo: (red: number, green: number, blue: number) => boolean): Promise<number> {
  const pixels = await pixelsOf(page, `#view-${view}`);
  return countPixels(pixels, isSo) / (pixels.length / 4);
}

const isOrange = (r: number, g: number, b: number): boolean => r > 120 && r > 1.5 * g && g > 1.5 * b;
const isBlue = (r: number, g: number, b: number): boolean => b > 90 && b > 1.5 * r && b > g;

async function mapped(page: Page): Promise<void> {
  await openDemo(page, '#demo=sphere-tetrahedron');
  await runMap(page);
  await openStep(page, 'method');
  await page.getByRole('checkbox', { name: 'Landmarks' }).uncheck();
}

test('ribbons, circles and coordinates lie on both meshes, as large and turned as one likes', { tag: '@long' }, async ({ page }) => {
  await mapped(page);
  await showSurface(page, 'Ribbons');
  for (const view of VIEWS) {
    await expect.poll(() => share(page, view, isOrange)).toBeGreaterThan(0.01);
    expect(await share(page, view, isBlue)).toBeGreaterThan(0.01);
  }
  await showSurface(page, 'Circles');
  for (const view of VIEWS) {
    await expect.poll(() => share(page, view, isOrange)).toBeLessThan(0.001);
  }
  await showSurface(page, 'Coordinates');
  for (const view of VIEWS) {
    await expect.poll(() => share(page, view, (r, g, b) => r > 1.3 * b && r > 1.1 * g)).toBeGreaterThan(0.005);
    expect(await share(page, view, (r, g, b) => g > 1.3 * b && g > 1.1 * r)).toBeGreaterThan(0.005);
  }
  // Each slider changes the picture, and setting it back restores the picture.
  await page.getByRole('button', { name: 'Picture: Coordinates' }).click();
  await page.getByRole('radio', { name: 'Ribbons', exact: true }).check();
  for (const name of ['texture-cells', 'texture-turn', 'texture-x', 'texture-y']) {
    const slider = page.locator(`input[name="${name}"]`);
    const value = await slider.inputValue();
    const before = await pixelsOf(page, '#view-source');
    const differ = async (): Promise<number> => {
      const now = await pixelsOf(page, '#view-source');
      return now.reduce((count, byte, at) => count + (Math.abs(byte - (before[at] ?? 0)) > 60 ? 1 : 0), 0) / now.length;
    };
    await slider.fill(name === 'texture-turn' ? '90' : name === 'texture-cells' ? '10' : '3');
    if (name === 'texture-y') {
      // Ribbons run in this direction, so a shift along it changes nothing.
      await expect.poll(differ).toBeLessThan(0.001);
    } else {
      await expect.poll(differ, name).toBeGreaterThan(0.01);
    }
    await slider.fill(value);
    await expect.poll(differ, name).toBeLessThan(0.001);
  }
});

test('a picture of one’s own lies on both meshes; what is no picture is told, and nothing is lost', { tag: '@long' }, async ({ page }) => {
  await mapped(page);
  await page.locator('#texture-file').setInputFiles({ name: 'two.png', mimeType: 'image/png', buffer: await halvesPicture(page, ['#e60a0a', '#0ac80a'], [64, 64]) });
  await expect(page.getByRole('button', { name: 'Picture: Your picture' })).toBeVisible();
  for (const view of VIEWS) {
    await expect.poll(async () => (await seen(page, view)).red).toBeGreaterThan(0.01);
    expect((await seen(page, view)).green).toBeGreaterThan(0.01);
  }
  await page.locator('#texture-file').setInputFiles({ name: 'two.txt', mimeType: 'text/plain', buffer: Buffer.from('no picture') });
  await expect(page.getByText('two.txt: This is no PNG, JPEG or WebP file')).toBeVisible();
  const head = Buffer.from('89504e470d0a1a0a0000000d494844520000ea600000c350080600000000000000', 'hex');
  await page.locator('#texture-file').setInputFiles({ name: 'huge.png', mimeType: 'image/png', buffer: head });
  await expect(page.getByText('huge.png: The picture has 60000 x 50000 pixels')).toBeVisible();
  expect((await seen(page, 'source')).red).toBeGreaterThan(0.01);
  await page.getByRole('button', { name: 'Close the message' }).click();
  await showSurface(page, 'Checkerboard');
  await expect.poll(async () => (await seen(page, 'source')).red).toBe(0);
  await showSurface(page, 'Your picture');
  await expect.poll(async () => (await seen(page, 'source')).red).toBeGreaterThan(0.01);
});

/** Points at a place near the middle of a view, and returns the numbers in the sentence about it. */
async function told(page: Page, sentence: RegExp): Promise<readonly number[]> {
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('the view has no box');
  await page.mouse.move(box.x + 5, box.y + 5);
  await page.mouse.move(box.x + 0.53 * box.width, box.y + 0.47 * box.height, { steps: 3 });
  const line = page.locator('#status');
  await expect(line).toContainText(sentence);
  const [, ...numbers] = sentence.exec((await line.textContent()) ?? '') ?? [];
  return numbers.map((text) => Number(text.replace('·10⁻', 'e-').replace(/[⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (digit) => String('⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(digit)))));
}

const NUMBER = '(-?[\\d.]+(?:·10⁻[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?)';

test('heat maps of the map have a legend and tell the value under the mouse', async ({ page }) => {
  await mapped(page);
  await showSurface(page, 'Distortion');
  const [distortion = 0] = await told(page, new RegExp(`: distortion ${NUMBER} \\(1: none\\)`));
  expect(distortion).toBeGreaterThanOrEqual(1);
  await showSurface(page, 'Angles');
  await expect(page.getByRole('img', { name: /distortion of angles from 1/ })).toBeVisible();
  const [angles = 0] = await told(page, new RegExp(`Angles here are distorted by ${NUMBER}`));
  expect(angles).toBeGreaterThanOrEqual(1);
  await showSurface(page, 'Areas');
  await expect(page.getByText('1/4 of its area')).toBeVisible();
  const [areas = 0] = await told(page, new RegExp(`Areas here grow by the factor ${NUMBER}`));
  expect(areas).toBeGreaterThan(0.3);
  expect(areas).toBeLessThan(3);
  // (s1² + s2² + s1⁻² + s2⁻²) / 4 = angle (area + 1 / area) / 2; both sides are smoothed around points.
  expect((angles * (areas + 1 / areas)) / 2 / distortion).toBeCloseTo(1, 0);
});

test('heat maps of the flow: the conformal factor, and the curvature of a sphere before it and after', { tag: '@long' }, async ({ page }) => {
  await mapped(page);
  await showSurface(page, 'Conformal factor');
  await expect(page.getByText(/1\/\d+ of its length/)).toBeVisible({ timeout: 60_000 });
  const [onSource = 0, onTarget = 0] = await told(page, new RegExp(`Lengths here grow by ${NUMBER} on the source, ${NUMBER} on the target`));
  expect(Math.min(onSource, onTarget)).toBeGreaterThan(0.05);
  expect(Math.max(onSource, onTarget)).toBeLessThan(20);
  await showSurface(page, 'Curvature');
  const [sphere = 0] = await told(page, new RegExp(`Curvature here, in units of a sphere’s: ${NUMBER} on the source`));
  expect(sphere).toBeGreaterThan(0.8);
  expect(sphere).toBeLessThan(1.2);
  await showSurface(page, 'Curvature, flat');
  const [flat = 1] = await told(page, new RegExp(`Curvature here after the flow, in units of a sphere’s: ${NUMBER} on the source`));
  expect(Math.abs(flat)).toBeLessThan(1e-3);
  await expect(page.getByText('100 × sphere')).toBeVisible();
  // With another surface the usual picture is shown again.
  await showSurface(page, 'Plain');
  await expect(page.getByText('100 × sphere')).toHaveCount(0);
});
