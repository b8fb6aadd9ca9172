/** Refused meshes are shown, with their defects painted and listed; a click turns the camera to a defect. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { countPixels, pixelsOf, SETTLED } from './canvas.ts';
import { DATA, drop, dropContents, needsSharedData, open, ROOT } from './page.ts';

type Point = readonly [number, number, number];

/** A ball: rings of latitude between two poles, of quads and triangles that face outwards. */
function ball(rings: number, around: number): { readonly points: Point[]; readonly faces: number[][] } {
  const points: Point[] = [[0, 1, 0]];
  for (let i = 1; i < rings; i++) {
    for (let j = 0; j < around; j++) {
      const [a, b] = [(Math.PI * i) / rings, (2 * Math.PI * j) / around];
      points.push([Math.sin(a) * Math.sin(b), Math.cos(a), Math.sin(a) * Math.cos(b)]);
    }
  }
  points.push([0, -1, 0]);
  const at = (i: number, j: number): number => 1 + (i - 1) * around + (j % around);
  const faces: number[][] = [];
  for (let j = 0; j < around; j++) {
    faces.push([0, at(1, j), at(1, j + 1)]);
    for (let i = 1; i < rings - 1; i++) {
      faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    faces.push([points.length - 1, at(rings - 1, j + 1), at(rings - 1, j)]);
  }
  return { points, faces };
}

/** A large ball with a hole and a turned patch, and a small one beside it; it has two parts, so it is refused. */
function bad(): string {
  const large = ball(12, 24);
  const turned = new Set([149, 150, 161, 162]);
  const faces = large.faces.flatMap((face, k) => (k === 126 ? [] : [turned.has(k) ? face.toReversed() : face]));
  const small = ball(8, 12);
  const first = large.points.length;
  const points = [...large.points, ...small.points.map(([x, y, z]): Point => [0.5 * x + 2, 0.5 * y, 0.5 * z])];
  const all = [...faces, ...small.faces.map((face) => face.map((v) => v + first))];
  return [...points.map((p) => `v ${p.join(' ')}`), ...all.map((f) => `f ${f.map((v) => v + 1).join(' ')}`)].join('\n');
}

/** The number of pixels of a view that are near a colour, which is given as in style sheets. */
async function pixelsNear(page: Page, view: string, colour: string): Promise<number> {
  const [red = 0, green = 0, blue = 0] = [1, 3, 5].map((k) => Number.parseInt(colour.slice(k, k + 2), 16));
  return countPixels(await pixelsOf(page, view), (r, g, b) => Math.abs(r - red) + Math.abs(g - green) + Math.abs(b - blue) < 40);
}

const RIM = '#d55e00';
const PATCH = '#0072b2';

test.beforeEach(({ page }) => {
  page.on('pageerror', (error) => {
    throw error;
  });
});

test('a refused mesh is painted, its defects turn the camera, and the repaired one is drawn as usual', async ({ page }) => {
  await open(page, '#demo=sphere-tetrahedron');
  const target = page.locator('#view-target');
  await expect(target).toContainText('sphere-tetrahedron-target.obj', { timeout: 60_000 });
  const labels = target.locator('.labels span:visible');
  await expect(labels.first()).toBeVisible();
  await page.locator('#target-file').setInputFiles({ name: 'bad.obj', mimeType: 'text/plain', buffer: Buffer.from(bad()) });

  await expect(target).toContainText(/bad\.obj .*not accepted/);
  const list = page.locator('.refused-mesh .defects');
  await expect(list.locator('summary')).toHaveText(['1 open rim', '1 patch that is turned over', '1 part beside the largest']);
  // Nothing of the mesh that waits behind it is visible.
  await expect(labels).toHaveCount(0);
  await page.waitForTimeout(SETTLED);
  await page.screenshot({ path: `${ROOT}test-results/defects-made.png` });
  for (const kind of ['open_rim', 'turned_patch']) {
    await list.locator(`[data-kind=${kind}] button`).first().click();
    await page.waitForTimeout(SETTLED);
    await page.screenshot({ path: `${ROOT}test-results/defects-made-${kind}.png` });
    expect(await pixelsNear(page, '#view-target', kind === 'open_rim' ? RIM : PATCH), kind).toBeGreaterThan(100);
  }

  // When it is left out, the earlier mesh is shown again; when it is refused anew and repaired, it is drawn like every mesh.
  await page.getByRole('button', { name: 'Leave it out' }).click();
  await expect(target).toContainText('sphere-tetrahedron-target.obj');
  await expect(labels.first()).toBeVisible();
  await dropContents(page, [{ name: 'bad.obj', content: bad() }]);
  await page.getByRole('button', { name: /^Keep the largest part/ }).click();
  const view = page.locator('.view', { hasText: 'bad.obj' });
  await expect(view).toContainText(/bad\.obj .*repaired/);
  await expect(page.locator('.refused-mesh')).toHaveCount(0);
  await page.locator('#step-meshes').click();
  await page.getByRole('button', { name: 'Show where' }).click();
  await expect(page.locator('.defects summary')).toHaveText([
    '1 open rim',
    '1 patch that is turned over',
    '1 part beside the largest',
    '1 cap',
  ]);
  await page.locator('[data-kind=cap] button').click();
  await page.waitForTimeout(SETTLED);
  await page.screenshot({ path: `${ROOT}test-results/defects-repaired.png` });
  await page.getByRole('button', { name: 'Hide the repairs' }).click();
  await expect(page.locator('.defects')).toHaveCount(0);
});

/** Meshes of the data folder that cannot be mapped as they are. */
const BAD = [
  'camel-nonmanifold.off',
  'cow-pinched-vertex.off',
  'genus1-rocker-arm.off',
  'horse-slit.off',
  'open-teapot.off',
  'suzanne-parts.off',
];

test('every bad mesh is painted', { tag: '@long' }, async ({ page }) => {
  needsSharedData();
  await open(page, '#demo=sphere-tetrahedron');
  for (const name of BAD) {
    await drop(page, [`${DATA}/bad/${name}`]);
    const caption = page.locator('.caption', { hasText: name });
    await expect(caption).toContainText(/not accepted|repaired/, { timeout: 60_000 });
    if ((await page.getByRole('button', { name: 'Leave it out' }).count()) === 0) {
      await page.locator('#step-meshes').click();
      await page.getByRole('button', { name: 'Show where' }).first().click();
    }
    await expect(page.locator('.defects summary').first()).toBeVisible({ timeout: 60_000 });
    await page.waitForTimeout(SETTLED);
    await page.screenshot({ path: `${ROOT}test-results/bad-${name}.png` });
    await page.locator('.defects details').first().locator('button').first().click({ timeout: 5000 }).catch(async () => {
      await page.locator('.defects summary').first().click();
      await page.locator('.defects details').first().locator('button').first().click();
    });
    await page.waitForTimeout(SETTLED);
    await page.screenshot({ path: `${ROOT}test-results/bad-${name}-near.png` });
    const leave = page.getByRole('button', { name: 'Leave it out' });
    if ((await leave.count()) > 0) {
      await leave.click();
    }
    await expect(page.locator('#error')).toBeHidden();
  }
});
