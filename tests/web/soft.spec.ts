/** Soft landmarks: their points on the target settle when the map is made, and one step undoes that. */
import { readFileSync } from 'node:fs';
import { expect, test } from './test.ts';
import { openDemo, openStep, pairs, ROOT, runMap } from './page.ts';

interface SavedFile {
  readonly pairs: readonly (readonly [unknown, unknown])[];
  readonly radii?: readonly number[];
}

test('a soft landmark settles when the map is made, and is held there; undo gives the click back', { tag: '@long' }, async ({ page }) => {
  const saved = async (): Promise<SavedFile> => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save file' }).click()]);
    return JSON.parse(readFileSync(await download.path(), 'utf8')) as SavedFile;
  };
  await openDemo(page);
  await openStep(page, 'landmarks');
  const given = await saved();
  expect(given.radii).toBeUndefined();

  const soft = page.getByRole('button', { name: 'Soft pair 3', exact: true });
  await soft.click();
  await expect(soft).toHaveAttribute('aria-pressed', 'true');
  const radius = page.getByRole('spinbutton', { name: /^Radius of pair 3/ });
  await expect(radius).toHaveValue('2');
  await radius.fill('99');
  await radius.press('Tab');
  await expect(radius).toHaveValue('25');
  await radius.fill('3');
  await radius.press('Tab');
  expect((await saved()).radii).toEqual(given.pairs.map((_, index) => (index === 2 ? 0.03 : 0)));
  await page.screenshot({ path: `${ROOT}test-results/soft.png` });

  await runMap(page);
  await expect(page.locator('#toast')).toContainText(/The soft pair settled, \d\.\d % of the target’s size away, and is held there\./);
  await openStep(page, 'landmarks');
  await expect(soft).toHaveAttribute('aria-pressed', 'false');
  const settled = await saved();
  expect(settled.radii).toBeUndefined();
  expect(settled.pairs[2]?.[1]).toMatchObject({ barycentric: [expect.any(Number), expect.any(Number), expect.any(Number)] });
  expect(settled.pairs.toSpliced(2, 1)).toEqual(given.pairs.toSpliced(2, 1));

  await page.keyboard.press('Control+z');
  await expect(soft).toHaveAttribute('aria-pressed', 'true');
  expect((await saved()).pairs).toEqual(given.pairs);
  await openStep(page, 'map');
  await expect(page.getByText(/This map was made before pair 3 was moved/)).toBeVisible();
  await openStep(page, 'landmarks');
  await page.keyboard.press('Control+y');
  await expect(soft).toHaveAttribute('aria-pressed', 'false');
});

test('the rows stay where they are when the field of a soft pair comes and goes', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const second = page.getByRole('textbox', { name: 'Name of pair 2', exact: true });
  const place = await second.boundingBox();
  await page.getByRole('button', { name: 'Soft pair 1', exact: true }).click();
  await expect(page.getByRole('spinbutton', { name: /^Radius of pair 1/ })).toBeInViewport({ ratio: 1 });
  expect(await second.boundingBox()).toEqual(place);
  await second.click();
  await expect(page.getByRole('spinbutton')).toHaveCount(0);
  expect(await second.boundingBox()).toEqual(place);
});

test('radii that are none are refused in a sentence, and nothing is lost', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const count = await pairs(page).count();
  const four = '"pairs": [[1, 2], [3, 4], [5, 6], [7, 8]]';
  for (const [radii, sentence] of [
    ['[0.01]', /has 1 radii for 4 pairs/],
    ['[0, 0, 0.5, 0]', /pair 3 .* has the radius 0\.5: it must lie between 0 and 0\.25/],
    ['[0, -1, 0, 0]', /pair 2 .* has the radius -1/],
  ] as const) {
    const buffer = Buffer.from(`{${four}, "radii": ${radii}}`);
    await page.locator('#landmark-file').setInputFiles({ name: 'radii.json', mimeType: 'application/json', buffer });
    await expect(page.locator('#error p')).toHaveText(sentence);
    await expect(pairs(page)).toHaveCount(count);
  }
  const buffer = Buffer.from(`{${four}, "radii": [0, 0.01, 0, 0]}`);
  await page.locator('#landmark-file').setInputFiles({ name: 'radii.json', mimeType: 'application/json', buffer });
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(4);
  await expect(page.getByRole('button', { name: 'Soft pair 2', exact: true })).toHaveAttribute('aria-pressed', 'true');
});
