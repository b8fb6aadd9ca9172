/** Nothing is lost: undo and redo, reloads, new visits, and two tabs. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import type { Upload } from './own-files.ts';
import { ownFiles, upload } from './own-files.ts';
import { dropContents, kept, TETRAHEDRON } from './page.ts';

async function open(page: Page, hash = ''): Promise<void> {
  await page.goto(`/${hash}`);
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
  await expect(page.locator('body')).toHaveAttribute('data-state', 'idle', { timeout: 60_000 });
}

async function shows(page: Page, source: string, target: string, pairs: number): Promise<void> {
  await expect(page.locator('#view-source')).toContainText(source);
  await expect(page.locator('#view-target')).toContainText(target);
  await expect(page.locator('body')).toHaveAttribute('data-pairs', String(pairs));
}

/** Opens the user's own files one after the other. */
async function openOwn(page: Page, target: Upload): Promise<number> {
  const { horse, landmarks, pairs } = ownFiles();
  await page.locator('#source-file').setInputFiles(horse);
  await expect(page.locator('#view-source')).toContainText('horse.obj');
  await page.locator('#target-file').setInputFiles(target);
  await expect(page.locator('#view-target')).toContainText('cat.obj');
  await page.locator('#landmark-file').setInputFiles(landmarks);
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  return pairs;
}

test('a target that was mirrored is taken back with all landmarks, and mirrored again', async ({ page }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().turned);
  await page.locator('#run').click();
  await page.getByRole('button', { name: 'Mirror the target' }).click({ timeout: 120_000 });
  await shows(page, 'horse.obj', 'cat (mirrored).obj', pairs);
  await expect(page.getByText('The target is its mirror image now')).toBeVisible();
  await page.keyboard.press('Control+z');
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  await page.keyboard.press('Control+Shift+Z');
  await shows(page, 'horse.obj', 'cat (mirrored).obj', pairs);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+y');
  await shows(page, 'horse.obj', 'cat (mirrored).obj', pairs);
  // Undo leads back to the first demo, through the landmarks, the target and the source.
  for (let step = 0; step < 4; step++) {
    await page.keyboard.press('Control+z');
  }
  await expect(page.locator('body')).toHaveAttribute('data-demo', 'horse-cat');
  await shows(page, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await page.keyboard.press('Control+z');
  await shows(page, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await expect(page.locator('#error')).toBeHidden();
});

/** A torus, which has one handle. */
function ring(): string {
  const lines: string[] = [];
  const [around, tube] = [12, 8];
  const at = (i: number, j: number): number => (i % around) * tube + (j % tube) + 1;
  const each = Array.from({ length: around * tube }, (_, k) => [Math.floor(k / tube), k % tube] as const);
  for (const [i, j] of each) {
    const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / tube];
    const out = 2 + Math.cos(b);
    lines.push(`v ${out * Math.cos(a)} ${out * Math.sin(a)} ${Math.sin(b)}`);
  }
  for (const [i, j] of each) {
    lines.push(`f ${at(i, j)} ${at(i + 1, j)} ${at(i + 1, j + 1)}`, `f ${at(i, j)} ${at(i + 1, j + 1)} ${at(i, j + 1)}`);
  }
  return lines.join('\n');
}

test('a mesh with a handle waits beside the good one, is cut by a click, undone, and there again after a reload', async ({ page }) => {
  await open(page);
  await dropContents(page, [{ name: 'corner.obj', content: TETRAHEDRON }, { name: 'ring.obj', content: ring() }]);
  await expect(page.locator('#view-source')).toContainText('corner.obj');
  await expect(page.locator('#view-target')).toContainText(/ring\.obj .*not accepted/);
  const refused = page.locator('.notice.refused');
  await expect(refused).toContainText(/^ring\.obj: The surface has 1 handle \(at vertex \d+ a loop of 8 edges, /);
  await refused.getByRole('button', { name: 'Cut 1 handle and cap it' }).click();
  await expect(page.locator('#view-target')).toContainText(/ring\.obj .*repaired/);
  await expect(refused).toHaveCount(0);
  const toast = page.locator('#toast');
  await expect(toast).toContainText(/^ring\.obj: 1 handle was cut and closed \(/);
  await toast.getByRole('button', { name: 'Undo' }).click();
  await expect(page.locator('#view-target')).not.toContainText('ring.obj');
  await page.keyboard.press('Control+Shift+Z');
  await expect(page.locator('#view-target')).toContainText('ring.obj');
  await kept(page, 0);
  await page.reload();
  await expect(page.locator('#view-target')).toContainText('ring.obj', { timeout: 60_000 });
  await expect(page.locator('#error')).toBeHidden();
});

test('a demo chosen over landmarks is undone from its note, and a map that was made is there again', async ({ page }) => {
  test.setTimeout(300_000);
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await page.locator('#run').click();
  await expect(page.locator('body')).toHaveAttribute('data-state', 'done', { timeout: 200_000 });
  await page.evaluate(() => {
    location.hash = '#demo=horse-cat';
  });
  await shows(page, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await expect(page.locator('body')).toHaveAttribute('data-state', 'idle');
  await page.getByRole('button', { name: 'Undo', exact: true }).first().click();
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  await expect(page.locator('body')).toHaveAttribute('data-state', 'done');
  await expect(page.locator('body')).toHaveAttribute('data-demo', '');
  expect(new URL(page.url()).hash).toBe('');
});

test('a reload in the middle goes on with the work and its steps', async ({ page }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await kept(page, pairs);
  await page.reload();
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  await expect(page.getByRole('button', { name: 'Start anew' })).toBeHidden();
  await page.keyboard.press('Control+z');
  await shows(page, 'horse.obj', 'cat.obj', 0);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await shows(page, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await page.keyboard.press('Control+y');
  await page.keyboard.press('Control+y');
  await page.keyboard.press('Control+y');
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  await expect(page.locator('#run')).toBeEnabled();
});

test('a step made just before the page goes is kept', async ({ page }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await kept(page, pairs);
  await page.keyboard.press('Control+z');
  await page.reload();
  await shows(page, 'horse.obj', 'cat.obj', 0);
});

test('a new visit is asked whether to continue, beside a linked demo too', { tag: '@long' }, async ({ page, context }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await kept(page, pairs);
  await page.close();

  const second = await context.newPage();
  await open(second, '#demo=horse-cat');
  await expect(second.getByText(`Continue with horse and cat, ${pairs} pairs?`)).toBeVisible();
  await shows(second, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await second.getByRole('button', { name: 'Continue', exact: true }).click();
  await shows(second, 'horse.obj', 'cat.obj', pairs);
  await second.keyboard.press('Control+z');
  await shows(second, 'horse.obj', 'cat.obj', 0);
  await kept(second, 0);
  await second.keyboard.press('Control+y');
  await kept(second, pairs);
  await second.close();

  const third = await context.newPage();
  await open(third);
  await third.getByRole('button', { name: 'Start anew' }).click();
  await expect(third.getByRole('button', { name: 'Start anew' })).toBeHidden();
  await third.close();

  const fourth = await context.newPage();
  await open(fourth);
  await fourth.waitForTimeout(1000);
  await expect(fourth.getByRole('button', { name: 'Start anew' })).toBeHidden();
});

test('two tabs do not disturb each other', { tag: '@long' }, async ({ page, context }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await kept(page, pairs);
  const other = await context.newPage();
  await open(other, '#demo=horse-cat');
  await shows(other, 'horse-cat-source.obj', 'horse-cat-target.obj', pairs);
  await expect(other.getByRole('button', { name: 'Start anew' })).toBeHidden();
  await other.locator('#landmark-file').setInputFiles(upload('four.json', '{"pairs": [[1, 2], [30, 40], [500, 600], [700, 800]]}'));
  await shows(other, 'horse-cat-source.obj', 'horse-cat-target.obj', 4);
  await kept(other, 4);
  await shows(page, 'horse.obj', 'cat.obj', pairs);
  await page.keyboard.press('Control+z');
  await kept(page, 0);
  await other.reload();
  await page.reload();
  await shows(other, 'horse-cat-source.obj', 'horse-cat-target.obj', 4);
  await shows(page, 'horse.obj', 'cat.obj', 0);
});

test('keys that are typed into a field are the field’s', async ({ page }) => {
  await open(page, '#demo=horse-cat');
  const pairs = await openOwn(page, ownFiles().cat);
  await page.evaluate(() => {
    const field = document.createElement('input');
    field.id = 'a-field';
    field.type = 'text';
    document.body.append(field);
  });
  await page.locator('#a-field').fill('nose');
  await page.keyboard.press('Control+z');
  await shows(page, 'horse.obj', 'cat.obj', pairs);
});
