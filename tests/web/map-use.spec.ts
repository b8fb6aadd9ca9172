/** The uses of a finished map in the views: morph, wipe, proposed partners, worst places. All tests share one page and one map. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Spot } from './canvas.ts';
import { bothDecoded, countDraws, distance, drawn, heads, moves, SETTLED, STEM } from './canvas.ts';
import { fail, openDemo, openStep, runMap, showSurface } from './page.ts';

interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** The distance from the line of the wipe at which its grip is not in the way, in pixels. */
const BESIDE_LINE = 22;
/** The distance from a pin's foot at which a click does not take the pin, in pixels. */
const BESIDE_PIN = 9;
/** A time longer than the way to the target's shape and back on a slow machine, in ms. */
const PLAYED = 30_000;

test.describe.configure({ mode: 'serial' });

let page: Page;

test.beforeAll(async ({ browser }) => {
  page = await browser.newPage();
  await countDraws(page);
  await openDemo(page);
  await runMap(page);
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
});

test.afterAll(async () => {
  await page.close();
});

async function boxOf(view: string): Promise<Box> {
  return (await page.locator(view).boundingBox()) ?? fail(`${view} has no box`);
}

/** The part of a view between its caption and its bars. */
async function inside(view: string): Promise<Box> {
  const { x, y, width, height } = await boxOf(view);
  return { x: Math.round(x) + 10, y: Math.round(y) + 50, width: Math.round(width) - 20, height: Math.round(height) - 120 };
}

/** A picture of a part of the window, as PNG in base64. */
async function seen(clip: Box): Promise<string> {
  return (await page.screenshot({ clip })).toString('base64');
}

/** The number of pixels at which two pictures differ by more than shading, in the columns from `from` up to, but without, `to`. */
async function differing(a: string, b: string, from: number, to: number): Promise<number> {
  const [one, other] = await bothDecoded(page, a, b);
  let count = 0;
  for (let at = 0; at < one.pixels.length; at += 4) {
    const x = (at / 4) % one.width;
    const by = Math.max(...[0, 1, 2].map((k) => Math.abs((one.pixels[at + k] ?? 0) - (other.pixels[at + k] ?? 0))));
    count += x >= from && x < to && by > 24 ? 1 : 0;
  }
  return count;
}

function slider(): ReturnType<Page['locator']> {
  return page.getByRole('slider', { name: 'Shape of the source' });
}

test('the source moves into the target’s shape by a slider, and marks nothing there', async () => {
  const clip = await inside('#view-source');
  const before = await seen(clip);
  const target = await seen(await inside('#view-target'));
  await drawn(page);
  await slider().focus();
  await page.keyboard.press('End');
  await expect(slider()).toHaveAttribute('aria-valuetext', 'the target’s shape');
  await page.waitForTimeout(SETTLED);
  expect((await drawn(page)).calls).toBeGreaterThan(0);
  expect(await differing(before, await seen(clip), 0, clip.width)).toBeGreaterThan(5000);
  // The target stands still.
  expect(await differing(target, await seen(await inside('#view-target')), 0, clip.width)).toBe(0);
  await expect(page.locator('#view-source .labels span:visible')).toHaveCount(0);
  await expect(page.locator('#view-target .labels span:visible')).not.toHaveCount(0);

  const pairs = await page.locator('#view-target .labels span').count();
  await page.mouse.click(clip.x + clip.width / 2, clip.y + clip.height / 2);
  await expect(page.locator('.toast')).toContainText('another shape');
  expect(await page.locator('#view-target .labels span').count()).toBe(pairs);
  await page.mouse.move(5, 5);

  await slider().focus();
  await page.keyboard.press('Home');
  await page.locator('.toast').waitFor({ state: 'hidden' });
  await page.waitForTimeout(SETTLED);
  expect(await differing(before, await seen(clip), 0, clip.width)).toBe(0);
});

test('it is played there and back, and draws no frame once it is still', async () => {
  const clip = await inside('#view-source');
  const before = await seen(clip);
  const button = page.locator('#play-morph');
  await drawn(page);
  await button.click();
  await expect(button).toHaveAccessibleName('Stop here');
  await expect.poll(async () => Number(await slider().inputValue())).toBeGreaterThan(50);
  await expect(button).toHaveAccessibleName(/^Play/, { timeout: PLAYED });
  await expect(slider()).toHaveValue('0');
  expect((await drawn(page)).calls).toBeGreaterThan(10);
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  await drawn(page);
  await page.waitForTimeout(1500);
  expect((await drawn(page)).calls).toBe(0);
  expect(await differing(before, await seen(clip), 0, clip.width)).toBe(0);

  // The playback stops where it is told to.
  await button.click();
  // The click is made in the page, without delay: on a busy machine a click from outside may come after the end, and play again.
  await page.waitForFunction(
    ([stop, at]) => Number((at as HTMLInputElement).value) > 5 && ((stop as HTMLElement).click(), true),
    [await button.elementHandle(), await slider().elementHandle()],
  );
  const share = await slider().inputValue();
  await page.waitForTimeout(SETTLED);
  expect(await slider().inputValue()).toBe(share);
  await slider().focus();
  await page.keyboard.press('Home');
});

test('where motion is reduced it is in the other shape at once', async () => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const button = page.locator('#play-morph');
  await button.click();
  await expect(slider()).toHaveValue('100');
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  await drawn(page);
  await button.press('Enter');
  await expect(slider()).toHaveValue('0');
  await page.waitForTimeout(SETTLED);
  // One or two frames are drawn, with the surfaces and pins of both views.
  expect((await drawn(page)).calls).toBeLessThan(20);
  await page.emulateMedia({ reducedMotion: null });
});

test('a line wipes what the map carries across the source', { tag: '@long' }, async () => {
  const clip = await inside('#view-source');
  const view = await boxOf('#view-source');
  await showSurface(page, 'Plain');
  await expect(page.locator('#wipe')).toBeDisabled();
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  const plain = await seen(clip);
  await showSurface(page, 'Pattern');
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  const carried = await seen(clip);
  const body = await differing(plain, carried, 0, clip.width);
  expect(body).toBeGreaterThan(5000);

  const expectWiped = async (share: number): Promise<void> => {
    await page.mouse.move(5, 5);
    await page.waitForTimeout(SETTLED);
    const wiped = await seen(clip);
    const line = view.x + share * view.width - clip.x;
    const [left, right] = [line - BESIDE_LINE, line + BESIDE_LINE];
    // On the left the mesh is drawn plain; only the shading of its outline differs, because the triangles are others.
    expect(await differing(wiped, plain, 0, left)).toBeLessThan(0.01 * body);
    expect(await differing(wiped, carried, 0, left)).toBeGreaterThan(0.9 * (await differing(plain, carried, 0, left)));
    // On the right the picture is exactly what the map carries.
    expect(await differing(wiped, carried, right, clip.width)).toBe(0);
    expect(await differing(plain, carried, 0, left)).toBeGreaterThan(0.02 * body);
    expect(await differing(plain, carried, right, clip.width)).toBeGreaterThan(0.02 * body);
  };
  await page.locator('#wipe').click();
  const line = page.getByRole('slider', { name: /that the map carries onto it/ });
  await expect(line).toHaveAttribute('aria-valuenow', '50');
  await expectWiped(0.5);

  await page.mouse.move(view.x + view.width / 2, view.y + 80);
  await page.mouse.down();
  await page.mouse.move(view.x + 0.35 * view.width, view.y + 90, { steps: 5 });
  await page.mouse.up();
  await expect(line).toHaveAttribute('aria-valuenow', '35');
  await expectWiped(0.35);
  await line.focus();
  for (let press = 0; press < 10; press++) {
    await page.keyboard.press('ArrowRight');
  }
  await expect(line).toHaveAttribute('aria-valuenow', '55');
  await expectWiped(0.55);

  await page.locator('#wipe').click();
  await expect(line).toHaveCount(0);
  await page.mouse.move(5, 5);
  await page.waitForTimeout(SETTLED);
  expect(await differing(carried, await seen(clip), 0, clip.width)).toBe(0);
});

/** A pin that is visible in both views, and places on the body beside its foot, towards the middle. */
async function pinOfBoth(): Promise<{ number: string; source: Spot; target: Spot }> {
  const [source, target] = [await heads(page, '#view-source'), await heads(page, '#view-target')];
  const middle = (all: ReadonlyMap<string, Spot>): Spot => {
    const spots = [...all.values()];
    return {
      x: spots.reduce((sum, { x }) => sum + x, 0) / spots.length,
      y: spots.reduce((sum, { y }) => sum + y, 0) / spots.length,
    };
  };
  const beside = (spot: Spot, all: ReadonlyMap<string, Spot>): Spot => ({
    x: spot.x + BESIDE_PIN * (Math.sign(middle(all).x - spot.x) || 1),
    y: spot.y + STEM,
  });
  const both = [...source].flatMap(([number, spot]) => {
    const partner = target.get(number);
    const outwards = distance(spot, middle(source)) + (partner === undefined ? 0 : distance(partner, middle(target)));
    return partner === undefined ? [] : [{ number, source: beside(spot, source), target: beside(partner, target), outwards }];
  });
  return both.sort((a, b) => a.outwards - b.outwards)[0] ?? fail('no pin is seen in both views');
}

test('a click on one side proposes its image on the other, which Enter makes a pair', async () => {
  await openStep(page, 'landmarks');
  const rows = page.locator('#landmark-list [data-pair]');
  const before = await rows.count();
  const number = String(before + 1);
  const ghost = page.locator('#view-target .labels span:visible', { hasText: `${number}?` });
  // The image of a place beside a landmark is beside the landmark's partner.
  const pin = await pinOfBoth();
  await page.mouse.click(pin.source.x, pin.source.y);
  await expect(ghost).toHaveCount(1);
  await expect(page.locator('#hint')).toContainText(`Pair ${number}: click the see-through pin that the map proposes`);
  await expect(page.locator('#proposal')).toContainText(`Pair ${number}`);
  await page.waitForTimeout(SETTLED);
  const at = (await heads(page, '#view-target')).get(`${number}?`) ?? fail('no ghost');
  const partner = (await heads(page, '#view-target')).get(pin.number) ?? fail('no partner');
  expect(distance(at, partner)).toBeLessThan(40);
  expect(await rows.count()).toBe(before);

  await page.keyboard.press('Enter');
  await expect(rows).toHaveCount(before + 1);
  await expect(ghost).toHaveCount(0);
  // The pin is at the place of the ghost.
  await page.waitForTimeout(SETTLED);
  const placed = (await heads(page, '#view-target')).get(number) ?? fail('no pin');
  expect(distance(placed, at)).toBeLessThan(1);
  await expect(page.locator('#undo')).toHaveAttribute('title', /Take the map’s place/);
  await page.keyboard.press('Control+z');
  await expect(rows).toHaveCount(before);
  await expect(ghost).toHaveCount(1);

  // Escape drops the ghost first, and then the half pair.
  await page.locator('#view-source').focus();
  await page.keyboard.press('Escape');
  await expect(ghost).toHaveCount(0);
  await expect(page.locator('#hint')).toContainText(`Pair ${number}: now click the same place`);
  await page.keyboard.press('Escape');
  await expect(page.locator('#hint')).toContainText('to add a pair');
});

test('a click on the ghost takes it, a click elsewhere places the partner there', async () => {
  await openStep(page, 'landmarks');
  const rows = page.locator('#landmark-list [data-pair]');
  const before = await rows.count();
  const number = String(before + 1);
  const pin = await pinOfBoth();
  const begin = async (view: '#view-source' | '#view-target'): Promise<Spot> => {
    const { x, y } = view === '#view-source' ? pin.source : pin.target;
    await page.mouse.click(x, y);
    const other = view === '#view-source' ? '#view-target' : '#view-source';
    await expect(page.locator(`${other} .labels span:visible`, { hasText: `${number}?` })).toHaveCount(1);
    await page.waitForTimeout(SETTLED);
    return (await heads(page, other)).get(`${number}?`) ?? fail('no ghost');
  };
  const toTarget = await begin('#view-source');
  await page.mouse.click(toTarget.x, toTarget.y);
  await expect(rows).toHaveCount(before + 1);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await expect(page.locator('#hint')).toContainText('to add a pair');

  // The same in the other direction, with a click at another place than the proposed one.
  const toSource = await begin('#view-target');
  await page.mouse.click(toSource.x, toSource.y + STEM + 14);
  await expect(rows).toHaveCount(before + 1);
  await page.waitForTimeout(SETTLED);
  const placed = (await heads(page, '#view-source')).get(number) ?? fail('no pin');
  expect(Math.abs(placed.y - toSource.y - 14)).toBeLessThan(2);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
});

test('the next worst place comes before both cameras, with a ring in each view', async () => {
  await openStep(page, 'map');
  const button = page.locator('#next-worst');
  const views = ['#view-source', '#view-target'] as const;
  let last = '';
  for (const press of [1, 2]) {
    const before = [await heads(page, views[0]), await heads(page, views[1])] as const;
    await button.click();
    await expect(page.locator('.worst-places')).toContainText(new RegExp(`^.*${press} of \\d+`));
    await page.waitForTimeout(SETTLED);
    const text = await page.locator('.worst-places').innerText();
    expect(text).not.toBe(last);
    last = text;
    for (const [index, view] of views.entries()) {
      const after = await heads(page, view);
      const gone = [...(before[index] ?? [])].filter(([number]) => !after.has(number)).length;
      expect(gone + moves(before[index] ?? new Map<string, Spot>(), after).filter((by) => by > 10).length, view).toBeGreaterThan(0);
    }
  }
  const middles = await Promise.all(
    views.map(async (view) => {
      const { x, y, width, height } = await boxOf(view);
      return { x: Math.round(x + width / 2) - 20, y: Math.round(y + height / 2) - 20, width: 40, height: 40 };
    }),
  );
  const rings = [];
  for (const clip of middles) {
    rings.push(await seen(clip));
  }
  // The rings disappear when the mouse moves.
  const { x, y } = await boxOf(views[0]);
  await page.mouse.move(x + 4, y + 60);
  await page.waitForTimeout(SETTLED);
  for (const [index, clip] of middles.entries()) {
    const ring = rings[index] ?? fail('no picture');
    expect(await differing(ring, await seen(clip), 0, 40), views[index]).toBeGreaterThan(30);
  }
});
