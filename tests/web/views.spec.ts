/** Cameras and pins that a user turns, zooms, drags and nudges; the tests read where the pins' numbers are. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Spot } from './canvas.ts';
import { countDraws, distance, drawn, heads, keepPreviews, moves, previewTimes, SETTLED, STEM } from './canvas.ts';
import { fail, openStep, showSurface } from './page.ts';

async function open(page: Page): Promise<void> {
  await countDraws(page);
  await page.goto('/#demo=horse-cat');
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  await page.waitForTimeout(SETTLED);
}

/** The number of a visible pin that is away from all others. */
async function lonelyPin(page: Page, view: string): Promise<string> {
  const all = [...(await heads(page, view))];
  const nearest = (index: number): number =>
    Math.min(...all.map(([, spot], other) => (other === index ? Infinity : distance(spot, all[index]?.[1] ?? spot))));
  const best = all.map((_, index) => index).sort((a, b) => nearest(b) - nearest(a))[0] ?? fail('no pin is seen');
  return all[best]?.[0] ?? fail('no pin is seen');
}

async function headOf(page: Page, view: string, number: string): Promise<Spot> {
  return (await heads(page, view)).get(number) ?? fail(`pin ${number} of ${view} is not seen`);
}

/** The longest time between the arrival of a coarse map and its drawing, in ms. */
const DRAWN_AFTER = 500;

test('frames are drawn only when something is seen to change', async ({ page }) => {
  await keepPreviews(page);
  await open(page);
  const faces = Number(/([\d,]+) triangles/.exec(await page.locator('#view-source').innerText())?.[1]?.replace(',', ''));
  await drawn(page);
  await page.waitForTimeout(1500);
  expect((await drawn(page)).calls).toBe(0);

  // A run reports its progress in words, so that a frame is drawn only for a coarse map.
  await page.locator('#run').click();
  await expect(page.locator('body')).toHaveAttribute('data-state', 'running');
  await drawn(page);
  await page.waitForTimeout(1000);
  await expect(page.locator('body')).toHaveAttribute('data-state', 'running');
  const { at } = await drawn(page);
  const told = await previewTimes(page);
  expect(at.filter((time) => !told.some((preview) => time >= preview && time < preview + DRAWN_AFTER))).toEqual([]);
  await expect(page.locator('body')).toHaveAttribute('data-state', 'done', { timeout: 200_000 });

  // The plain view draws the user's own triangles; the map's, which are many more, are drawn only where they are needed.
  await showSurface(page, 'Plain');
  await page.waitForTimeout(SETTLED);
  await drawn(page);
  await page.locator('#view-source').focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(SETTLED);
  const plain = await drawn(page);
  expect(plain.calls).toBeGreaterThan(1);
  expect(plain.triangles).toBeLessThanOrEqual(1.5 * faces);
  await showSurface(page, 'Distortion');
  await page.waitForTimeout(SETTLED);
  expect((await drawn(page)).triangles).toBeGreaterThan(1.5 * faces);
});

test('the cameras turn together and glide', { tag: '@long' }, async ({ page }) => {
  await open(page);
  const before = [await heads(page, '#view-source'), await heads(page, '#view-target')] as const;
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no box');
  // On the ground beside the body no pin is taken.
  await page.mouse.move(box.x + 8, box.y + box.height - 30);
  await page.mouse.down();
  await page.mouse.move(box.x + 48, box.y + box.height - 30, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(SETTLED);
  for (const [index, view] of ['#view-source', '#view-target'].entries()) {
    const moved = moves(before[index] ?? fail('no view'), await heads(page, view));
    expect(Math.max(...moved), view).toBeGreaterThan(5);
  }
  // After the reset the pins are where they were at first.
  await page.locator('#view-source').focus();
  await page.keyboard.press('0');
  await page.waitForTimeout(SETTLED);
  for (const [index, view] of ['#view-source', '#view-target'].entries()) {
    const moved = moves(before[index] ?? fail('no view'), await heads(page, view));
    expect(Math.max(...moved), view).toBeLessThan(1);
  }
});

test('the wheel brings nearer what is under the mouse, which stays there', { tag: '@long' }, async ({ page }) => {
  await open(page);
  const number = await lonelyPin(page, '#view-source');
  const before = await heads(page, '#view-source');
  const head = before.get(number) ?? fail('not seen');
  await page.mouse.move(head.x, head.y + STEM);
  for (let notch = 0; notch < 3; notch++) {
    await page.mouse.wheel(0, -100);
    await page.waitForTimeout(100);
  }
  await page.waitForTimeout(SETTLED);
  const after = await heads(page, '#view-source');
  expect(distance(head, after.get(number) ?? fail('gone'))).toBeLessThan(4);
  // All other pins move away from it.
  const base = { x: head.x, y: head.y + STEM };
  const grown = [...after].filter(([other]) => other !== number && before.has(other)).map(([other, spot]) => {
    const old = before.get(other) ?? fail('not seen');
    return distance({ x: spot.x, y: spot.y + STEM }, base) / distance({ x: old.x, y: old.y + STEM }, base);
  });
  expect(grown.length).toBeGreaterThan(0);
  expect(Math.min(...grown)).toBeGreaterThan(1.2);
});

test('a double click brings a place to the middle, and a click alone still picks', async ({ page }) => {
  await open(page);
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Clear all' }).click();
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no box');
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.click(middle.x + 20, middle.y);
  await expect(page.locator('#view-source .labels span:visible')).toHaveCount(1);
  const before = await headOf(page, '#view-source', '1');
  expect(Math.abs(before.x - middle.x - 20)).toBeLessThan(2);
  expect(Math.abs(before.y + STEM - middle.y)).toBeLessThan(2);
  await page.mouse.dblclick(middle.x - 25, middle.y);
  await page.waitForTimeout(SETTLED);
  // There is no second point; the first one has moved to the right, since the double click has brought another place to the middle.
  await expect(page.locator('#view-source .labels span:visible')).toHaveCount(1);
  const after = await headOf(page, '#view-source', '1');
  expect(after.x - before.x).toBeGreaterThan(10);
});

test('a pin is dragged on its surface, and one step takes it back', async ({ page }) => {
  await open(page);
  const number = await lonelyPin(page, '#view-source');
  const start = await headOf(page, '#view-source', number);
  const others = await heads(page, '#view-source');
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no box');
  const inwards = Math.sign(box.x + box.width / 2 - start.x) || 1;
  await page.mouse.move(start.x, start.y);
  await page.mouse.down();
  await page.mouse.move(start.x + inwards * 6, start.y, { steps: 3 });
  await page.mouse.move(start.x + inwards * 12, start.y, { steps: 6 });
  await page.mouse.up();
  await page.waitForTimeout(SETTLED);
  const end = await headOf(page, '#view-source', number);
  expect(Math.abs(end.x - start.x - inwards * 12)).toBeLessThan(2.5);
  others.delete(number);
  // The camera has not moved.
  expect(Math.max(...moves(others, await heads(page, '#view-source')))).toBeLessThan(1);
  await page.keyboard.press('Control+z');
  await page.waitForTimeout(SETTLED);
  expect(distance(start, await headOf(page, '#view-source', number))).toBeLessThan(1);
});

test('a pin that was clicked obeys the keys', { tag: '@long' }, async ({ page }) => {
  await open(page);
  await openStep(page, 'landmarks');
  const number = await lonelyPin(page, '#view-source');
  const pairs = await page.locator('#landmark-list [data-pair]').count();
  const start = await headOf(page, '#view-source', number);
  const left = start.x > ((await page.locator('#view-source').boundingBox())?.x ?? 0) + 200;
  await page.mouse.click(start.x, start.y);
  await expect(page.locator('#view-source .labels .raised')).toHaveText(number);
  await expect(page.locator('#view-target .labels .raised')).toHaveCount(1);
  await page.mouse.move(5, 5);
  await page.keyboard.press(left ? 'Shift+ArrowLeft' : 'Shift+ArrowRight');
  await expect.poll(async () => Math.abs((await headOf(page, '#view-source', number)).x - start.x)).toBeGreaterThan(3);
  const coarse = await headOf(page, '#view-source', number);
  await page.keyboard.press(left ? 'ArrowRight' : 'ArrowLeft');
  const step = async (): Promise<number> => distance(await headOf(page, '#view-source', number), coarse);
  await expect.poll(step).toBeGreaterThan(0.2);
  expect(await step()).toBeLessThan(2);
  await page.keyboard.press('Delete');
  await expect(page.locator('#landmark-list [data-pair]')).toHaveCount(pairs - 1);
  // The next pair is selected; after it is deselected, the arrow keys turn the view again.
  await page.keyboard.press('Escape');
  await expect(page.locator('#view-source .labels .raised')).toHaveCount(0);
  const before = await heads(page, '#view-source');
  await page.keyboard.press('ArrowLeft');
  await expect.poll(async () => Math.max(...moves(before, await heads(page, '#view-source')))).toBeGreaterThan(5);
});

test('keys zoom, look from six sides and fit', { tag: '@long' }, async ({ page }) => {
  await open(page);
  const view = page.locator('#view-source');
  await view.focus();
  const spread = async (): Promise<number> => {
    const all = [...(await heads(page, '#view-source')).values()];
    return Math.max(...all.map(({ x }) => x)) - Math.min(...all.map(({ x }) => x));
  };
  const before = await spread();
  await page.keyboard.press('PageDown');
  await page.waitForTimeout(SETTLED);
  const small = await spread();
  expect(small).toBeLessThan(0.85 * before);
  await page.keyboard.press('PageUp');
  await page.waitForTimeout(SETTLED);
  expect(Math.abs((await spread()) - before)).toBeLessThan(3);
  for (const key of ['F', 'B', 'L', 'R', 'T', 'U']) {
    const earlier = await heads(page, '#view-source');
    await page.keyboard.press(`Shift+${key}`);
    await page.waitForTimeout(SETTLED);
    const later = await heads(page, '#view-source');
    const changes = [...earlier].some(([number, spot]) => distance(spot, later.get(number) ?? { x: -99, y: -99 }) > 3);
    expect(changes, key).toBe(true);
    const box = (await view.boundingBox()) ?? fail('no box');
    for (const { x, y } of later.values()) {
      expect(x > box.x && x < box.x + box.width && y + STEM > box.y && y < box.y + box.height, key).toBe(true);
    }
  }
  await page.keyboard.press('q');
  await page.keyboard.press('PageDown');
  await page.waitForTimeout(SETTLED);
  const away = await spread();
  await page.keyboard.press('f');
  await page.waitForTimeout(SETTLED);
  expect(await spread()).not.toBeCloseTo(away, 0);
});

test('with a map the place under the mouse is marked in both views', async ({ page }) => {
  await open(page);
  await page.locator('#run').click();
  await expect(page.locator('body')).toHaveAttribute('data-state', 'done', { timeout: 200_000 });
  await page.waitForTimeout(SETTLED);
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('no box');
  const target = (await page.locator('#view-target').boundingBox()) ?? fail('no box');
  await page.mouse.move(box.x + 6, box.y + box.height - 6);
  await page.waitForTimeout(SETTLED);
  const without = await page.screenshot({ clip: target });
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForTimeout(SETTLED);
  const withRing = await page.screenshot({ clip: target });
  expect(withRing.equals(without)).toBe(false);
  await page.mouse.move(box.x + 6, box.y + box.height - 6);
  await page.waitForTimeout(SETTLED);
  expect((await page.screenshot({ clip: target })).equals(without)).toBe(true);
});

/** How alike the pins of both views lie, those that are seen in both: 1 where they lie in the same way, less where one view is turned. */
async function alike(page: Page): Promise<number> {
  const [source, target] = [await heads(page, '#view-source'), await heads(page, '#view-target')];
  const both = [...source.keys()].filter((number) => target.has(number));
  expect(both.length).toBeGreaterThan(2);
  const away = (pins: Map<string, Spot>): number[] => {
    const spots = both.map((number) => pins.get(number) ?? fail(`pin ${number} is not seen`));
    const mean = (of: (spot: Spot) => number): number => spots.reduce((sum, spot) => sum + of(spot), 0) / spots.length;
    const [x, y] = [mean((spot) => spot.x), mean((spot) => spot.y)];
    return spots.flatMap((spot) => [spot.x - x, spot.y - y]);
  };
  const [a, b] = [away(source), away(target)];
  const dot = (p: readonly number[], q: readonly number[]): number => p.reduce((sum, value, k) => sum + value * (q[k] ?? 0), 0);
  return dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b));
}

test('a body that lies otherwise in its file is seen as the other one is', async ({ page }) => {
  await open(page);
  expect(await alike(page)).toBeGreaterThan(0.9);
  await page.getByRole('button', { name: 'Turn the target upright' }).click();
  const axis = (name: string): ReturnType<Page['getByRole']> => page.getByRole('button', { name, exact: true });
  await axis('X up').click();
  await page.waitForTimeout(SETTLED);
  expect(await alike(page)).toBeLessThan(0.8);
  await page.getByRole('button', { name: 'Look at the target from a side' }).click();
  await page.getByRole('button', { name: 'As the source is seen' }).click();
  await page.waitForTimeout(SETTLED);
  expect(await alike(page)).toBeGreaterThan(0.9);
  await page.getByRole('button', { name: 'Turn the target upright' }).click();
  await expect(axis('Y up')).toHaveAttribute('aria-pressed', 'true');
});
