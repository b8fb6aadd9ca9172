/** The boundary of the texture that a map carries, red on both meshes (thesis fig. 4.5). */
import { expect, test } from './test.ts';
import { seen } from './canvas.ts';
import { openDemo, openStep, runMap } from './page.ts';

const VIEWS = ['source', 'target'] as const;

test('the demo of the cone shows where its texture is cut, on the ball as well', { tag: '@long' }, async ({ page }) => {
  await openDemo(page, '#demo=ball-cone');
  await runMap(page);
  await openStep(page, 'method');
  await page.getByRole('checkbox', { name: 'Landmarks' }).uncheck();
  const boundary = page.getByRole('checkbox', { name: 'Texture boundary' });
  await expect(boundary).toBeChecked();
  await expect(page.getByRole('button', { name: 'Picture: Checkerboard' })).toBeVisible();
  await expect(page.getByText('where the texture is cut')).toBeVisible();
  for (const view of VIEWS) {
    await expect.poll(async () => (await seen(page, view)).red).toBeGreaterThan(0.001);
  }
  await boundary.uncheck();
  for (const view of VIEWS) {
    await expect.poll(async () => (await seen(page, view)).red).toBe(0);
  }
});

test('the next demo comes in the usual picture', async ({ page }) => {
  await openDemo(page, '#demo=ball-cone');
  await openStep(page, 'meshes');
  await page.locator('[data-demo-id="sphere-tetrahedron"]').click();
  await expect(page.locator('body')).toHaveAttribute('data-demo', 'sphere-tetrahedron');
  await openStep(page, 'method');
  await expect(page.getByRole('checkbox', { name: 'Texture boundary' })).not.toBeChecked();
  await expect(page.getByRole('button', { name: 'Picture: Plain' })).toBeVisible();
});
