/** Left and right together: one click makes two pairs, one step undoes them, and a map is made from them. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Spot } from './canvas.ts';
import { distance, heads, SETTLED, STEM } from './canvas.ts';
import { fail, openDemo, openStep, pairs, ROOT, runMap } from './page.ts';

const VIEWS = ['#view-source', '#view-target'] as const;

/** The places of the demo's landmarks in a view, by their labels, as far as they are visible. */
async function places(page: Page, view: string): Promise<ReadonlyMap<string, Spot>> {
  const names = await page.locator('#landmark-list input').evaluateAll((inputs) => inputs.map((input) => (input as HTMLInputElement).value));
  const seen = [...(await heads(page, view))];
  return new Map(seen.map(([number, { x, y }]) => [names[Number(number) - 1] ?? '', { x, y: y + STEM }]));
}

/** Waits until both views are still, however slowly frames come. */
async function stillness(page: Page): Promise<void> {
  let before = '';
  await expect(async () => {
    await page.waitForTimeout(SETTLED);
    const now = JSON.stringify([...(await heads(page, VIEWS[0])), ...(await heads(page, VIEWS[1]))]);
    const isStill = now === before;
    before = now;
    expect(isStill).toBe(true);
  }).toPass();
}

/** Clicks, and waits until another click would not make a double click. */
async function click(page: Page, { x, y }: Spot): Promise<void> {
  await page.mouse.click(x, y);
  await page.waitForTimeout(500);
  await page.mouse.move(5, 5);
}

/** The place of a pin, by its number; it is shown with the next frame. */
async function pin(page: Page, view: string, number: string): Promise<Spot> {
  await expect.poll(async () => (await heads(page, view)).has(number), { message: `pin ${number} of ${view} is seen` }).toBe(true);
  const head = (await heads(page, view)).get(number) ?? fail(`pin ${number} of ${view} is not seen`);
  return { x: head.x, y: head.y + STEM };
}

test('a click on each mesh makes two whole pairs, which go together', { tag: '@long' }, async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  for (const view of VIEWS) {
    // Both ears are visible from the top.
    await page.locator(view).focus();
    await page.keyboard.press('Shift+T');
  }
  await stillness(page);
  const known = [await places(page, VIEWS[0]), await places(page, VIEWS[1])] as const;
  const spot = (side: 0 | 1, name: string): Spot => known[side].get(name) ?? fail(`${name} is not seen: ${[...known[side].keys()].join(', ')}`);
  await page.getByRole('button', { name: 'Clear all' }).click();

  const planes = page.getByRole('region', { name: 'Left and right' });
  await planes.getByRole('checkbox', { name: 'Left and right together' }).check();
  await expect(planes.getByRole('status')).toHaveText([
    /^The source is symmetric: its mirror image is 0\.0\d % of its size off on average\.$/,
    /^The target is symmetric: its mirror image is 0\.0\d % of its size off on average\.$/,
  ]);

  // There are two half pairs, and then two complete ones.
  const rows = page.locator('#landmark-list tr[data-id]');
  await click(page, spot(0, 'left ear'));
  await expect(rows).toHaveCount(2);
  await expect(pairs(page)).toHaveCount(0);
  await expect(page.locator('#hint')).toContainText('Pair 1: now click the same place on the target.');
  expect(distance(await pin(page, VIEWS[0], '2'), spot(0, 'right ear'))).toBeLessThan(8);
  await click(page, spot(1, 'left ear'));
  await expect(pairs(page)).toHaveCount(2);
  expect(distance(await pin(page, VIEWS[1], '2'), spot(1, 'right ear'))).toBeLessThan(8);

  // The label of the other side follows.
  const names = page.locator('#landmark-list input');
  await names.first().fill('left ear');
  await names.first().press('Enter');
  await expect(names.nth(1)).toHaveValue('right ear');
  await page.screenshot({ path: `${ROOT}test-results/left-right.png` });

  // Undo takes back the label, both targets and both pairs, and redo makes them again.
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await expect(rows).toHaveCount(2);
  await expect(pairs(page)).toHaveCount(0);
  await page.keyboard.press('Control+z');
  await expect(rows).toHaveCount(0);
  for (const count of [0, 2, 2]) {
    await page.keyboard.press('Control+Shift+z');
    await expect(pairs(page)).toHaveCount(count);
  }

  // The other ear is moved as well, on its side of the plane.
  const [ear, partner] = [await pin(page, VIEWS[0], '1'), await pin(page, VIEWS[0], '2')];
  await page.mouse.move(ear.x, ear.y - STEM);
  await page.mouse.down();
  await page.mouse.move(ear.x - 6, ear.y - STEM - 8, { steps: 6 });
  await page.mouse.up();
  await page.mouse.move(5, 5);
  await page.waitForTimeout(300);
  const moved = await pin(page, VIEWS[0], '2');
  expect(moved.x - partner.x).toBeLessThan(-3);
  expect(moved.y - partner.y).toBeGreaterThan(3);
  await page.keyboard.press('Control+z');

  // A point on the midline stays single.
  await click(page, spot(0, 'withers'));
  await expect(rows).toHaveCount(3);
  await click(page, spot(1, 'withers'));
  await expect(pairs(page)).toHaveCount(3);
  await click(page, spot(0, 'right flank'));
  await click(page, spot(1, 'right flank'));
  await expect(pairs(page)).toHaveCount(5);
  await runMap(page);

  // A proposal of the map is accepted for both sides.
  const [flank, croup] = [spot(0, 'right flank'), spot(0, 'croup')];
  await click(page, { x: (flank.x + croup.x) / 2, y: (flank.y + croup.y) / 2 });
  await expect(page.locator('#hint')).toContainText('Pair 6: click the see-through pin that the map proposes on the target');
  await page.locator('#view-target').focus();
  await page.keyboard.press('Enter');
  await expect(page.locator('body')).toHaveAttribute('data-pairs', '7');
});

test('a plane may be given, and a body without one says so', { tag: '@long' }, async ({ page }) => {
  await openDemo(page, '#demo=horse-turning');
  await openStep(page, 'landmarks');
  const planes = page.getByRole('region', { name: 'Left and right' });
  await planes.getByRole('checkbox', { name: 'Left and right together' }).check();
  await expect(planes.getByRole('status').last()).toHaveText(/^The target has no plane of symmetry: its mirror image at the best plane is 4\.\d % of its size off on average\./);
  await planes.getByLabel('Target plane').selectOption({ label: 'Across its z axis' });
  await expect(planes.getByRole('status').last()).toHaveText(/^Mirrored at this plane, the target is \d\.\d % of its size off on average\.$/);
});
