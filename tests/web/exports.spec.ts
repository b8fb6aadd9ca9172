/** What the page saves: landmark files that can be loaded again, and exports that other programs can read. */
import { readFileSync, writeFileSync } from 'node:fs';
import { expect, test } from './test.ts';
import { downloaded, glbFaults, readGlb } from './glb.ts';
import { DATA, finished, needsSharedData, openDemo, openStep, pairs, runMap } from './page.ts';

/** Checks the container, and that every index is that of a vertex; returns the number of triangles. */
function trianglesOfGlb(glb: Buffer): number {
  expect(glb.subarray(0, 4).toString()).toBe('glTF');
  expect([glb.readUInt32LE(4), glb.readUInt32LE(8)]).toEqual([2, glb.length]);
  const { document: gltf, binary } = readGlb(glb);
  expect(gltf.asset.version).toBe('2.0');
  const primitive = gltf.meshes[0]?.primitives[0];
  const indices = gltf.accessors[primitive?.indices ?? -1];
  const positions = gltf.accessors[primitive?.attributes['POSITION'] ?? -1];
  const view = gltf.bufferViews[indices?.bufferView ?? -1];
  if (indices === undefined || positions === undefined || view === undefined) {
    throw new Error('the GLB has no triangles');
  }
  expect(indices.componentType).toBe(5125);
  let largest = 0;
  for (let k = 0; k < indices.count; k++) {
    largest = Math.max(largest, binary.readUInt32LE((view.byteOffset ?? 0) + 4 * k));
  }
  expect(largest).toBe(positions.count - 1);
  return indices.count / 3;
}

test('landmarks and exports can be read again', async ({ page }) => {
  await openDemo(page);
  await openStep(page, 'landmarks');
  const rows = pairs(page);
  const count = await rows.count();
  const saved = await downloaded(page, 'Save file');
  await page.getByRole('button', { name: 'Clear all' }).click();
  await expect(rows).toHaveCount(0);
  await page.locator('#landmark-file').setInputFiles({ name: 'landmarks.json', mimeType: 'application/json', buffer: saved });
  await expect(rows).toHaveCount(count);
  expect((await downloaded(page, 'Save file')).toString()).toBe(saved.toString());

  await page.locator('#run').click();
  await finished(page);
  await openStep(page, 'use');
  const faces = Number(/([\d,]+) triangles/.exec(await page.locator('#view-source').innerText())?.[1]?.replace(',', ''));
  const vertices = faces / 2 + 2;
  const glb = await downloaded(page, 'GLB');
  expect(trianglesOfGlb(glb)).toBeGreaterThan(faces);
  expect(await glbFaults(glb)).toEqual([]);
  const [header, ...lines] = (await downloaded(page, 'CSV')).toString().trim().split('\n');
  expect(header?.split(',')).toHaveLength(8);
  expect(lines).toHaveLength(vertices);
  // All rows are checked in one `expect`, since each call takes milliseconds.
  const isRow = (line: string): boolean => {
    const numbers = line.split(',').map(Number);
    return numbers.length === 8 && numbers.every((number) => Number.isFinite(number)) && numbers.slice(0, 5).every((number) => number >= -1e-9);
  };
  expect(lines.filter((line) => !isRow(line))).toEqual([]);
  const base = (await downloaded(page, 'Base OBJ')).toString().split('\n');
  expect(base.filter((line) => line.startsWith('v '))).toHaveLength(count);
  expect(base.filter((line) => line.startsWith('f '))).toHaveLength(2 * count - 4);
  const report = JSON.parse((await downloaded(page, 'Report')).toString()) as { certificate: { bijective: boolean }; stopped_early: boolean };
  expect([report.certificate.bijective, report.stopped_early]).toEqual([true, false]);
  // These files are made from the map file on demand.
  const targetFaces = Number(/([\d,]+) triangles/.exec(await page.locator('#view-target').innerText())?.[1]?.replace(',', ''));
  const map = await downloaded(page, 'Map file');
  expect(map.subarray(0, 7).toString()).toBe('CONEMAP');
  const morph = await downloaded(page, 'Morph');
  expect(trianglesOfGlb(morph)).toBe(trianglesOfGlb(glb));
  expect(await glbFaults(morph)).toEqual([]);
  const [inverse, ...images] = (await downloaded(page, 'Inverse table')).toString().trim().split('\n');
  expect(inverse).toBe('target_vertex,source_face,b0,b1,b2,x,y,z');
  expect(images).toHaveLength(targetFaces / 2 + 2);
  const shape = (await downloaded(page, 'Source shape')).toString().split('\n');
  expect(shape.filter((line) => line.startsWith('v '))).toHaveLength(vertices);
  expect(shape.filter((line) => line.startsWith('f '))).toHaveLength(faces);
  expect((await downloaded(page, 'Layout')).toString()).toContain('<svg');

  // The lines are the source's own, except the positions, which are on the target.
  const wrapped = (await downloaded(page, 'Wrapped')).toString().split('\n');
  const places = (text: readonly string[]): readonly string[] => text.filter((line) => line.startsWith('v '));
  expect(places(wrapped)).toHaveLength(vertices);
  expect(wrapped.filter((line) => line.startsWith('f '))).toHaveLength(faces);
  const height = Math.max(...places(wrapped).map((line) => Number(line.split(' ')[2])));
  const shapeHeight = Math.max(...places(shape).map((line) => Number(line.split(' ')[2])));
  expect(Math.abs(height - shapeHeight)).toBeLessThan(0.05 * shapeHeight);
  await expect(page.getByText(`${vertices.toLocaleString('en-US').replaceAll(',', '')} vertices lie on the scan`)).toBeVisible();

  // A second program proves the map.
  await openStep(page, 'map');
  await page.locator('.shield summary').click();
  await page.locator('#prove').click();
  await expect(page.locator('#second-proof')).toContainText('Proved: the map is one-to-one', { timeout: 60_000 });
  await openStep(page, 'use');
  await openStep(page, 'map');
  await page.locator('.shield summary').click();
  await expect(page.locator('#second-proof')).toContainText('Proved');
});

test('a mirrored set is repaired by a click', { tag: '@long' }, async ({ page }) => {
  needsSharedData();
  await openDemo(page, '');
  // The mirror image of the lion: x is negated, and every triangle is turned.
  const [kind, sizes, ...lines] = readFileSync(`${DATA}/sumner/lion.off`, 'utf8').split(/\r?\n/).filter((line) => line.trim() !== '' && !line.startsWith('#'));
  const count = Number(sizes?.trim().split(/\s+/)[0]);
  const mirrored = lines.map((line, index) => {
    const words = line.trim().split(/\s+/);
    return index < count ? [String(-Number(words[0])), words[1], words[2]].join(' ') : [words[0], words[1], words[3], words[2]].join(' ');
  });
  const path = test.info().outputPath('lion.off');
  writeFileSync(path, [kind, sizes, ...mirrored].join('\n'));
  await page.locator('#source-file').setInputFiles(`${DATA}/sumner/cat.off`);
  await expect(page.locator('#view-source')).toContainText('cat.off');
  await page.locator('#target-file').setInputFiles(path);
  await expect(page.locator('#view-target')).toContainText('lion.off');
  await page.locator('#landmark-file').setInputFiles(`${DATA}/pairs/cat-lion.json`);
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(33);

  await page.locator('#run').click();
  await page.getByRole('button', { name: 'Mirror the target' }).click({ timeout: 120_000 });
  await expect(page.locator('#view-target')).toContainText('lion (mirrored).obj');
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(33);
  await runMap(page);
  await expect(page.locator('#findings')).toBeHidden();
});
