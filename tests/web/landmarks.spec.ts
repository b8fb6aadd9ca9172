/** Impossible landmark files and picks: they are reported at once, and nothing is lost. */
import { expect, test } from './test.ts';
import { openDemo, openStep, pairs } from './page.ts';

/** A tetrahedron with the midpoints of its edges: vertices and faces, numbered from 1 as in OBJ files. */
const VERTICES = ['1 1 1', '1 -1 -1', '-1 1 -1', '-1 -1 1', '1 0 0', '0 0 -1', '0 1 0', '0 0 1', '0 -1 0', '-1 0 0'];
const FACES = ['1 5 7', '5 2 6', '7 6 3', '5 6 7', '1 8 5', '8 4 9', '5 9 2', '8 9 5', '1 7 8', '7 3 10', '8 10 4', '7 10 8', '2 9 6', '9 4 10', '6 10 3', '9 10 6'];

/** The tetrahedron as an OBJ file, with vertices before it that no face uses. */
function tetrahedron(unused: number): string {
  const corner = (number: string): string => String(Number(number) + unused);
  const faces = FACES.map((face) => `f ${face.split(' ').map(corner).join(' ')}`);
  return [...Array<string>(unused).fill('v 9 9 9'), ...VERTICES.map((v) => `v ${v}`), ...faces].join('\n');
}

function file(name: string, text: string): { name: string; mimeType: string; buffer: Buffer } {
  return { name, mimeType: 'application/octet-stream', buffer: Buffer.from(text) };
}

test('landmark files that cannot be used are refused with the numbers of their pairs', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const rows = pairs(page);
  const count = await rows.count();
  const cases = [
    ['[[1, 2], [3, 4], [1, 5], [6, 7]]', /^wrong\.json: Landmark pairs 1 and 3 \(the first is 1\) have the same point of the source\.$/],
    ['[[1, 2], [3, 999999], [8, 5], [6, 7]]', /^wrong\.json: Landmark pair 2 .* names vertex 999999, but the target has [\d]+ vertices\. Load the meshes/],
    ['[[1, 2], [{"face": 9999999, "barycentric": [1, 0, 0]}, 5]]', /^wrong\.json: Landmark pair 2 .* names face 9999999/],
    ['[[1, 2], [{"face": 3, "barycentric": [1, 0.5, 0]}, 5]]', /^wrong\.json: Landmark pair 2 .* do not sum to 1: \[1\.0, 0\.5, 0\.0\]\.$/],
    ['[[1, 2], [{"face": 3, "barycentric": [null, 0.5, 0]}, 5]]', /^wrong\.json: The landmark file, line 1: a point must be/],
  ] as const;
  for (const [list, sentence] of cases) {
    await page.locator('#landmark-file').setInputFiles(file('wrong.json', `{"pairs": ${list}}`));
    await expect(page.locator('#error p')).toHaveText(sentence);
    await expect(rows).toHaveCount(count);
    await expect(page.locator('#view-source')).toContainText('horse-cat-source.obj');
    await expect(page.locator('#run')).toBeEnabled();
  }
});

test('landmarks speak of the vertices of the file', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  await page.locator('#source-file').setInputFiles(file('a.obj', tetrahedron(1)));
  await expect(page.locator('#view-source')).toContainText('a.obj');
  await page.locator('#target-file').setInputFiles(file('b.obj', tetrahedron(1)));
  await expect(page.locator('#view-target')).toContainText('b.obj');
  await page.locator('#landmark-file').setInputFiles(file('unused.json', '{"pairs": [[1, 1], [2, 2], [0, 3]]}'));
  await expect(page.locator('#error p')).toHaveText(/^unused\.json: Landmark pair 3 .* names vertex 0, which no face of the source uses\./);
  const text = '{"source": "a.obj", "target": "b.obj", "pairs": [[1, 1], [2, 2], [3, 3], [4, 4]]}';
  await page.locator('#landmark-file').setInputFiles(file('fine.json', text));
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(4);

  // A mesh of the same name with fewer vertices: the landmarks stay, and are named in the error.
  const bare = [...VERTICES.slice(0, 4).map((v) => `v ${v}`), 'f 1 2 3', 'f 1 4 2', 'f 1 3 4', 'f 2 4 3'].join('\n');
  await page.locator('#target-file').setInputFiles(file('b.obj', bare));
  await expect(page.locator('#error p')).toHaveText(/^Landmark pair 4 .* names vertex 4, but the target has 4 vertices\. The landmarks are kept/);
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(4);
  await page.locator('#target-file').setInputFiles(file('b.obj', tetrahedron(1)));
  await expect(page.locator('#error')).toBeHidden();

  await page.locator('#run').click();
  await expect(page.locator('#result')).toContainText(/Certified bijective: 0 of/, { timeout: 60_000 });
  const download = page.waitForEvent('download');
  await openStep(page, 'use');
  await page.getByRole('button', { name: 'CSV', exact: true }).click();
  const stream = await (await download).createReadStream();
  let csv = '';
  for await (const part of stream) {
    csv += String(part);
  }
  const lines = csv.trim().split('\n');
  expect(lines).toHaveLength(12);
  expect(lines[1]).toBe('0,,,,,,,');
  expect(lines.slice(2).every((line) => !line.includes(',,'))).toBe(true);
});

test('a click on a pin takes it and picks nothing', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Clear all' }).click();
  const rows = pairs(page);
  const raised = page.locator('#view-source .labels .raised');
  const middle = async (view: string): Promise<void> => {
    const box = await page.locator(view).boundingBox();
    expect(box).not.toBeNull();
    if (box !== null) {
      await page.mouse.click(box.x + box.width * 0.5, box.y + box.height * 0.5);
    }
    await page.waitForTimeout(600);
  };
  await middle('#view-source');
  await middle('#view-target');
  await expect(rows).toHaveCount(1);
  await page.locator('#view-source').focus();
  await page.keyboard.press('Escape');
  await page.mouse.move(5, 5);
  await expect(raised).toHaveCount(0);
  // The pin is at the place of the first click.
  await middle('#view-source');
  await page.mouse.move(5, 5);
  await expect(raised).toHaveText('1');
  await expect(page.locator('#error')).toBeHidden();
  await expect(rows).toHaveCount(1);
});

test('the list has the colours of the markers, each another', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const colours = await page
    .locator('#landmark-list .swatch')
    .evaluateAll((swatches) => swatches.map((swatch) => getComputedStyle(swatch).backgroundColor));
  expect(colours.length).toBeGreaterThan(3);
  expect(new Set(colours).size).toBe(colours.length);
  // The first landmark is red, like its marker.
  expect(colours[0]).toMatch(/^color\(srgb-linear 0\.67\d* 0\.019\d* 0\.046\d*\)$/);
});
