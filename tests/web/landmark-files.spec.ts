/** Landmark files of other programs and meshes in several files, opened and saved only by choosers and menus. */
import { readFileSync } from 'node:fs';
import type { Download, FileChooser, Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { zipSync } from 'fflate';
import { tetrahedron } from '../unit/tetrahedron.ts';
import { open, openDemo, openStep, pairs, TETRAHEDRON } from './page.ts';

type Point = number | { readonly face: number; readonly barycentric: readonly number[] };
interface Landmarks {
  readonly pairs: readonly (readonly [Point, Point])[];
  readonly labels?: readonly string[];
}

/** The files that an action downloads, in their order. */
async function downloads(page: Page, count: number, action: () => Promise<void>): Promise<{ name: string; mimeType: string; buffer: Buffer }[]> {
  const come: Download[] = [];
  const take = (download: Download): void => {
    come.push(download);
  };
  page.on('download', take);
  await action();
  await expect.poll(() => come.length).toBe(count);
  page.off('download', take);
  return Promise.all(
    come.map(async (download) => ({
      name: download.suggestedFilename(),
      mimeType: 'application/octet-stream',
      buffer: readFileSync(await download.path()),
    })),
  );
}

async function saved(page: Page): Promise<Landmarks> {
  const [file] = await downloads(page, 1, () => page.getByRole('button', { name: 'Save file' }).click());
  return JSON.parse(file?.buffer.toString() ?? '') as Landmarks;
}

/** Checks that points are the same, up to the rounding of weights. */
function expectSamePoints(found: Landmarks, wanted: Landmarks, format: string): void {
  expect(found.pairs, format).toHaveLength(wanted.pairs.length);
  found.pairs.forEach((pair, index) => {
    pair.forEach((point, side) => {
      const other = wanted.pairs[index]?.[side] ?? -1;
      if (typeof point === 'number' || typeof other === 'number') {
        expect(point, format).toEqual(other);
        return;
      }
      expect(point.face, format).toBe(other.face);
      point.barycentric.forEach((weight, corner) => {
        expect(weight, format).toBeCloseTo(other.barycentric[corner] ?? NaN, 9);
      });
    });
  });
}

/** Opens the menu of formats and goes to an entry, using only the keyboard. */
async function chooseByKeys(page: Page, name: RegExp): Promise<void> {
  await page.locator('#landmark-formats').focus();
  await page.keyboard.press('Enter');
  const entry = page.locator('#panel .popover .body button').filter({ hasText: name });
  await expect(entry).toBeEnabled();
  for (let press = 0; press < 20; press++) {
    await page.keyboard.press('ArrowDown');
    if (await entry.evaluate((button) => button === document.activeElement)) {
      return;
    }
  }
  throw new Error(`the arrows do not reach ${String(name)}`);
}

test('landmarks are saved in every format, and read back to the same points', { tag: '@long' }, async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const first = await saved(page);
  // Points inside faces are added to the demo's vertices.
  const inFaces = [
    [{ face: 40, barycentric: [0.25, 0.5, 0.25] }, 3],
    [9, { face: 71, barycentric: [0.1, 0.2, 0.7] }],
  ] as const;
  const given = { ...first, pairs: [...first.pairs, ...inFaces], labels: [...(first.labels ?? []), 'flank', 'hip, left'] };
  await page.locator('#landmark-file').setInputFiles({ name: 'given.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(given)) });
  await expect(pairs(page)).toHaveCount(given.pairs.length);

  await page.locator('#landmark-formats').click();
  const formats = await page.locator('[data-format]').evaluateAll((entries) =>
    entries.map((entry) => ({ id: entry.getAttribute('data-format') ?? '', isOneEach: entry.textContent.includes('2 ×') })),
  );
  await page.keyboard.press('Escape');
  expect(formats.map(({ id }) => id).toSorted()).toEqual(['conemap', 'csv', 'fcsv', 'idav', 'meshlab', 'nts', 'slicer-json', 'tps', 'wrap']);
  for (const { id, isOneEach } of formats) {
    await page.locator('#landmark-formats').click();
    const files = await downloads(page, isOneEach ? 2 : 1, () => page.locator(`[data-format="${id}"]`).click());
    await page.getByRole('button', { name: 'Clear all' }).click();
    await expect(pairs(page)).toHaveCount(0);
    await page.locator('#landmark-file').setInputFiles(files);
    await expect(pairs(page)).toHaveCount(given.pairs.length);
    await expect(page.locator('#error')).toBeHidden();
    expectSamePoints(await saved(page), given, id);
  }
  for (const file of ['.mrk.json', '.fcsv', '.pp', '.pts', '.tps', '.nts', '.dta', '.csv']) {
    const ending = file.slice(file.lastIndexOf('.'));
    expect((await page.locator('#landmark-file').getAttribute('accept'))?.split(',')).toContain(ending);
  }

  // A file of one mesh alone, whose name fits neither mesh: opened by keys, and through the chooser that they open.
  const choosers: FileChooser[] = [];
  page.on('filechooser', (chooser) => {
    choosers.push(chooser);
  });
  await chooseByKeys(page, /^MeshLab/);
  const [source, target] = await downloads(page, 2, () => page.keyboard.press('Enter'));
  await page.getByRole('button', { name: 'Clear all' }).click();
  if (source === undefined || target === undefined) {
    throw new Error('two files were expected');
  }
  await page.locator('#landmark-file').setInputFiles({ ...target, name: 'points.pp' });
  await expect(page.locator('#error p')).toContainText('these landmarks are for one mesh');
  for (const [name, file] of [
    ['target', target],
    ['source', source],
  ] as const) {
    const before = choosers.length;
    await chooseByKeys(page, new RegExp(`^For the ${name} alone`));
    await page.keyboard.press('Enter');
    await expect.poll(() => choosers.length).toBe(before + 1);
    await choosers.at(-1)?.setFiles({ ...file, name: 'points.pp' });
    await expect(page.locator('#landmark-list tr[data-id]')).toHaveCount(given.pairs.length);
  }
  await expect(pairs(page)).toHaveCount(given.pairs.length);
  expectSamePoints(await saved(page), given, 'one after the other');
});

test('meshes in several files come by the choosers: a set, a zip, an OBJ with its materials', async ({ page }) => {
  await openDemo(page);
  const mesh = tetrahedron('tetra.bin');
  const [gltf, bin] = [mesh.gltf, Buffer.from(mesh.bin)];
  const file = (name: string, content: string | Buffer): { name: string; mimeType: string; buffer: Buffer } => ({
    name,
    mimeType: 'application/octet-stream',
    buffer: Buffer.from(content),
  });
  await page.locator('#source-file').setInputFiles([file('tetra.bin', bin), file('tetra.gltf', gltf)]);
  await expect(page.locator('#view-source')).toContainText('tetra.glb');
  const zip = zipSync({ 'model/other.gltf': Buffer.from(gltf), 'model/tetra.bin': bin, 'model/skin.png': Buffer.from([1]) });
  await page.locator('#target-file').setInputFiles([file('model.zip', Buffer.from(zip))]);
  await expect(page.locator('#view-target')).toContainText('other.glb');
  const obj = 'mtllib skin.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n';
  await page.locator('#mesh-files').setInputFiles([
    file('a.obj', obj),
    file('skin.mtl', 'newmtl skin\n'),
    file('skin.jpg', Buffer.from([1, 2])),
    file('b.obj', obj),
    file('pairs.json', '{"source": "b.obj", "target": "a.obj", "pairs": [[0, 0], [1, 1], [2, 2], [3, 3]]}'),
  ]);
  await expect(page.locator('#view-source')).toContainText('b.obj');
  await expect(page.locator('#view-target')).toContainText('a.obj');
  await expect(page.locator('#error')).toBeHidden();
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(4);
  for (const chooser of ['#mesh-files', '#source-file', '#target-file']) {
    const endings = (await page.locator(chooser).getAttribute('accept'))?.split(',');
    expect(endings).toEqual(expect.arrayContaining(['.obj', '.gltf', '.bin', '.png', '.jpg', '.mtl', '.zip']));
    await expect(page.locator(chooser)).toHaveAttribute('multiple');
  }
});

test('landmarks alone say which meshes they wait for, and can be deleted', async ({ page }) => {
  await page.route('**/none.obj', async (route) => route.fulfill({ status: 404 }));
  await open(page, '#source=none.obj');
  await expect(page.locator('#error')).toBeVisible();
  const content = '{"source": "a.obj", "target": "b.obj", "pairs": [[0, 0], [1, 1], [2, 2], [3, 3]]}';
  await page.locator('#landmark-file').setInputFiles({ name: 'pairs.json', mimeType: 'application/json', buffer: Buffer.from(content) });
  const notice = page.locator('#landmarks-notice');
  await expect(notice).toContainText('4 landmark pairs wait for their source (a.obj) and their target (b.obj): drop them here.');
  await page.locator('#mesh-files').setInputFiles({ name: 'b.obj', mimeType: 'application/octet-stream', buffer: Buffer.from(TETRAHEDRON) });
  await expect(notice).toContainText('4 landmark pairs wait for their source (a.obj): drop it here.');
  await openStep(page, 'landmarks');
  await page.getByRole('button', { name: 'Lock pair 2', exact: true }).click();
  await notice.getByRole('button', { name: 'Delete the landmarks' }).click();
  await expect(page.getByText('3 landmark pairs deleted. 1 locked pair stayed.')).toBeVisible();
  await notice.getByRole('button', { name: 'Unlock the landmarks' }).click();
  await notice.getByRole('button', { name: 'Delete the landmarks' }).click();
  await expect(notice).toBeHidden();
  await expect(pairs(page)).toHaveCount(0);
});
