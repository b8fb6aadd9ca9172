/** The step Use brings what belongs to one mesh onto the other: values there and back, curves, poses, a texture; and refused files. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { unzipSync } from 'fflate';
import { buildDemo, initSync } from '../../www/wasm/page.js';
import type { Upload } from './own-files.ts';
import { upload } from './own-files.ts';
import { decoded, halvesPicture } from './canvas.ts';
import { fail, open, openDemo, openStep, runMap } from './page.ts';

type Point = readonly [number, number, number];

/** A mesh of a demo. */
interface Mesh {
  readonly obj: string;
  readonly points: readonly Point[];
  readonly faces: readonly (readonly number[])[];
}

interface Demo {
  readonly meshes: readonly [Mesh, Mesh];
  readonly landmarks: Uint8Array;
}

function numbersOf(text: string, kind: 'v' | 'f'): number[][] {
  const lines = text.split('\n').filter((line) => line.startsWith(`${kind} `));
  return lines.map((line) => line.trim().split(/\s+/).slice(1).map(Number));
}

function meshOf(bytes: Uint8Array): Mesh {
  const obj = new TextDecoder().decode(bytes);
  return { obj, points: numbersOf(obj, 'v').map(([x = 0, y = 0, z = 0]) => [x, y, z]), faces: numbersOf(obj, 'f') };
}

function demo(): Demo {
  initSync({ module: readFileSync(fileURLToPath(new URL('../../www/wasm/page_bg.wasm', import.meta.url))) });
  const built = buildDemo('sphere-tetrahedron') ?? fail('there is no such demo');
  return { meshes: [meshOf(built.source()), meshOf(built.target())], landmarks: built.landmarks() };
}

/** A mesh's file with texture coordinates, which `chart` gives for each face and corner. */
function withCharts({ points, faces }: Mesh, chart: (face: number, corner: number, point: Point) => readonly [number, number]): string {
  const places = points.map((point) => `v ${point.join(' ')}`);
  const charts = faces.flatMap((face, f) => face.map((v, k) => `vt ${chart(f, k, points[v - 1] ?? fail('no such vertex')).join(' ')}`));
  const corners = faces.map((face, f) => `f ${face.map((v, k) => `${v}/${3 * f + k + 1}`).join(' ')}`);
  return [...places, ...charts, ...corners, ''].join('\n');
}

/** The mesh with each face in a cell of its own in the texture. */
function cells(mesh: Mesh): string {
  const columns = Math.ceil(Math.sqrt(mesh.faces.length));
  const corners = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]] as const;
  return withCharts(mesh, (f, k) => {
    const [u, v] = corners[k] ?? fail('not a triangle');
    return [((f % columns) + u) / columns, (Math.floor(f / columns) + v) / columns];
  });
}

/** The mesh with texture coordinates by its view from the front. */
function seenFromFront(mesh: Mesh): string {
  const size = Math.max(...mesh.points.flat().map(Math.abs));
  return withCharts(mesh, (_f, _k, [x, y]) => [0.5 + (0.45 * x) / size, 0.5 + (0.45 * y) / size]);
}

const DEMO = demo();
const [SOURCE, TARGET] = DEMO.meshes;
const heights = TARGET.points.map(([, , z]) => z);

test.describe.configure({ mode: 'serial' });

let page: Page;

test.beforeAll(async ({ browser }) => {
  page = await browser.newPage();
  await open(page);
  await page.locator('#source-file').setInputFiles(upload('ball.obj', cells(SOURCE)));
  await expect(page.locator('#view-source')).toContainText('ball.obj');
  await page.locator('#target-file').setInputFiles(upload('stone.obj', seenFromFront(TARGET)));
  await expect(page.locator('#view-target')).toContainText('stone.obj');
  await page.locator('#landmark-file').setInputFiles(upload('pairs.json', DEMO.landmarks));
  await runMap(page);
  await openStep(page, 'use');
  await expect(page.getByRole('button', { name: 'Choose files…' })).toBeVisible();
});

test.afterAll(async () => {
  await page.close();
});

const panel = (): ReturnType<Page['locator']> => page.locator('#panel');

/** A list of choices by its label. */
const select = (label: string): ReturnType<Page['locator']> => panel().getByRole('combobox', { name: label, exact: true });

/** Chooses files, and waits until the page says what they are. */
async function choose(files: readonly Upload[], sentence: RegExp | string): Promise<void> {
  await page.locator('#bring-files').setInputFiles([...files]);
  await expect(panel().locator('.bring-kind')).toContainText(sentence);
}

async function from(direction: string): Promise<void> {
  await select('From').selectOption(direction);
}

interface Saved {
  readonly name: string;
  readonly bytes: Buffer;
}

/** Presses a button, and returns the file that it saves. */
async function saved(button: string): Promise<Saved> {
  const download = page.waitForEvent('download');
  await panel().getByRole('button', { name: button, exact: true }).click();
  const file = await download;
  const path = test.info().outputPath(file.suggestedFilename());
  await file.saveAs(path);
  await expect(panel().getByRole('alert')).toHaveCount(0);
  return { name: file.suggestedFilename(), bytes: readFileSync(path) };
}

/** The second column of a table, without its heading. */
function column(table: Buffer): number[] {
  return table.toString().trim().split('\n').slice(1).map((line) => Number(line.split(',')[1]));
}

test('values go there and back, and come as they were but for little', async () => {
  const table = `vertex,height\n${heights.map((z, v) => `${v},${z}`).join('\n')}\n`;
  await from('Target onto source');
  await choose([upload('height.csv', table)], 'height.csv: values of the target’s vertices, 1 column (height).');
  const there = await saved('Bring onto the source');
  expect(there.name).toBe('height-on-source.csv');
  expect(column(there.bytes)).toHaveLength(SOURCE.points.length);
  await expect(panel().getByText('Saved as height-on-source.csv.')).toBeVisible();
  expect((await saved('Save again')).bytes).toEqual(there.bytes);
  await page.screenshot({ path: test.info().outputPath('values.png') });

  await from('Source onto target');
  await choose([upload(there.name, there.bytes)], 'values of the source’s vertices');
  const back = column((await saved('Bring onto the target')).bytes);
  expect(back).toHaveLength(heights.length);
  const range = Math.max(...heights) - Math.min(...heights);
  expect(Math.max(...back.map((value, v) => Math.abs(value - (heights[v] ?? NaN))))).toBeLessThan(0.005 * range);
});

test('labels are not mixed, and a PLY file has them on the mesh', async () => {
  await from('Target onto source');
  const rows = TARGET.points.map(([x, y], v) => `${v},${x > 0 ? 3 : 8},${y}`);
  await choose([upload('parts.csv', `vertex,part,y\n${rows.join('\n')}\n`)], '2 columns (part, y)');
  await select('Columns hold').selectOption('Each its own');
  await select('part').selectOption('Labels');
  const there = (await saved('Bring onto the source')).bytes.toString().trim().split('\n').slice(1);
  expect(new Set(there.map((line) => line.split(',')[1]))).toEqual(new Set(['3', '8']));
  await select('Save as').selectOption('PLY mesh');
  await select('Method').selectOption('Sample');
  await page.screenshot({ path: test.info().outputPath('columns.png') });
  const ply = await saved('Bring onto the source');
  expect(ply.name).toBe('parts-on-source.ply');
  expect(ply.bytes.toString('latin1')).toMatch(new RegExp(`^ply[^]*element vertex ${SOURCE.points.length}[^]*property double part`));
});

test('a curve comes onto the other mesh', async () => {
  // A curve along the edges of a face.
  const face = TARGET.faces[0] ?? fail('no face');
  await choose([upload('ring.obj', `g ring\nl ${[...face, face[0]].join(' ')}\n`)], 'ring.obj: curves on the target.');
  const file = await saved('Bring onto the source');
  expect(file.name).toBe('ring-on-source.json');
  const { curves } = JSON.parse(file.bytes.toString()) as { curves: { name: string; closed: boolean; points: { face: number }[] }[] };
  expect(curves).toHaveLength(1);
  expect(curves[0]).toMatchObject({ name: 'ring', closed: true });
  expect(curves[0]?.points.every(({ face: on }) => on >= 0 && on < SOURCE.faces.length)).toBe(true);
  expect(curves[0]?.points.length).toBeGreaterThan(2);
});

test('the other mesh moves as a mesh does in two poses', async () => {
  const moved = (motion: (point: Point) => Point): string => TARGET.points.map((point) => `v ${motion(point).join(' ')}`).join('\n');
  const faces = TARGET.faces.map((face) => `f ${face.join(' ')}`).join('\n');
  const pose = (name: string, motion: (point: Point) => Point): Upload => upload(name, `${moved(motion)}\n${faces}\n`);
  const turned = ([x, y, z]: Point): Point => [1 - 2 * y, 2 * x, 2 * z - 3];
  await choose([pose('rest.obj', (point) => point), pose('turned.obj', turned)], '2 files: the target in other poses.');
  const archive = await saved('Bring onto the source');
  expect(archive.name).toBe('rest-and-others-on-source.zip');
  const frames = Object.entries(unzipSync(archive.bytes));
  expect(frames.map(([name]) => name)).toEqual(['frame-000.obj', 'frame-001.obj']);
  for (const [number, motion] of [(point: Point): Point => point, turned].entries()) {
    const points = meshOf(frames[number]?.[1] ?? fail('no frame')).points;
    const wanted = SOURCE.points.map(motion);
    const off = points.flatMap((point, v) => point.map((x, k) => Math.abs(x - (wanted[v]?.[k] ?? NaN))));
    expect(Math.max(...off)).toBeLessThan(1e-8);
  }
  await choose([pose('turned.obj', turned)], 'turned.obj: the target in another pose.');
  expect((await saved('Bring onto the source')).name).toBe('turned-on-source.obj');
});

test('a texture is baked over the other mesh’s own coordinates', async () => {
  await choose([upload('halves.png', await halvesPicture(page, ['#00f', '#f00'], [64, 64]))], 'halves.png: the target’s texture.');
  await select('Size').selectOption('512 × 512');
  const baked = await saved('Bring onto the source');
  expect(baked.name).toBe('halves-on-source.png');
  const { width, height, pixels } = await decoded(page, baked.bytes.toString('base64'));
  const shares = { red: 0, blue: 0, other: 0 };
  for (let k = 0; k < pixels.length; k += 4) {
    const [r = 0, g = 0, b = 0, a = 0] = pixels.subarray(k, k + 4);
    if (a > 0) {
      shares[r > 250 && g + b < 5 ? 'red' : b > 250 && g + r < 5 ? 'blue' : 'other'] += 1;
    }
  }
  const all = shares.red + shares.blue + shares.other;
  expect([width, height]).toEqual([512, 512]);
  expect([shares.red / all > 0.3, shares.blue / all > 0.3, shares.other / all < 0.1], JSON.stringify(shares)).toEqual([true, true, true]);
});

test('both meshes come in the other’s shape, with distances', async () => {
  const files = unzipSync((await saved('Shapes')).bytes);
  expect(Object.keys(files)).toEqual(['source-in-target-shape.obj', 'target-in-source-shape.obj', 'shape.json']);
  await expect(panel().getByText('Hausdorff distance')).toBeVisible();
});

test('what does not fit is told with its file and line, and nothing is lost', async () => {
  const refused = async (files: readonly Upload[], sentence: string): Promise<void> => {
    await page.locator('#bring-files').setInputFiles([...files]);
    await expect(panel().getByRole('alert')).toHaveText(sentence);
  };
  const misfit = async (name: string, table: string, sentence: string): Promise<void> => {
    await choose([upload(name, table)], `${name}: values`);
    await panel().getByRole('button', { name: 'Bring onto the source' }).click();
    await expect(panel().getByRole('alert')).toHaveText(sentence);
  };
  const count = TARGET.points.length;
  await misfit('short.csv', 'height\n1\n2\n', `short.csv: Header: it has 2 rows, but the mesh file has ${count} vertices: give each a row, or a first column \`vertex\`.`);
  await page.screenshot({ path: test.info().outputPath('refused.png') });
  await misfit('words.csv', 'vertex,height\n0,warm\n', 'words.csv: Line 2: "warm" should be a number of "height".');
  await refused(
    [upload('letter.txt', 'Dear reader\nthis is no table\n')],
    'letter.txt: Nothing in it can be brought across: give values as a table (CSV) or PLY, curves as OBJ lines, CSV or JSON, a texture as PNG, or the mesh in other poses.',
  );
  // Nothing is chosen any more: the button would bring the earlier file.
  await expect(panel().locator('.bring-kind')).toHaveCount(0);
  await expect(panel().getByRole('button', { name: 'Bring onto the source' })).toHaveCount(0);
  await refused([upload('empty.csv', '')], 'empty.csv: The file is empty.');
  await refused(
    [upload('semicolons.csv', 'vertex;height\n0;1,5\n')],
    'semicolons.csv: Its columns are separated by semicolons: save the table with commas between the columns, and with points in the numbers.',
  );
  await refused([upload('a.obj', TARGET.obj), upload('b.csv', 'height\n1\n')], 'b.csv: several files at once must be one mesh in several poses, and this is none. Bring it alone.');
  await choose([upload('other.obj', SOURCE.obj)], 'other.obj: the target in another pose.');
  await panel().getByRole('button', { name: 'Bring onto the source' }).click();
  await expect(panel().getByRole('alert')).toHaveText(
    `other.obj: It has ${SOURCE.points.length} vertices, but the mesh that it should be a frame of has ${count}.`,
  );
  await expect(page.locator('#error')).toBeHidden();
});

test('files that are dropped on the section are for it, and not for the views', async () => {
  const transfer = await page.evaluateHandle(() => {
    const data = new DataTransfer();
    data.items.add(new File(['curve,vertex\nc,0\n'], 'dot.csv'));
    return data;
  });
  await page.dispatchEvent('.bring-drop', 'dragover', { dataTransfer: transfer });
  await expect(page.locator('.drop-veil')).toHaveCount(0);
  await page.dispatchEvent('.bring-drop', 'drop', { dataTransfer: transfer });
  await expect(panel().locator('.bring-kind')).toHaveText('dot.csv: curves on the target.');
  await expect(page.locator('#error')).toBeHidden();
  // The choice stays while another step is open.
  await openStep(page, 'map');
  await openStep(page, 'use');
  await expect(panel().locator('.bring-kind')).toHaveText('dot.csv: curves on the target.');
  for (const [name, width, height] of [['large', 1440, 900], ['phone', 390, 844]] as const) {
    await page.setViewportSize({ width, height });
    await openStep(page, 'use');
    await panel().locator('.bring-drop').scrollIntoViewIfNeeded();
    for (const theme of ['light', 'dark'] as const) {
      await page.emulateMedia({ colorScheme: theme });
      await page.screenshot({ path: test.info().outputPath(`${name}-${theme}.png`) });
    }
  }
  await page.setViewportSize({ width: 1280, height: 800 });
});

test('what goes on is shown, and left when it is cancelled', async () => {
  await choose([upload('dots.csv', 'curve,vertex\nc,0\n')], 'dots.csv: curves on the target.');
  // The worker's script is never delivered.
  await page.route(/bring-worker/, () => undefined);
  let downloads = 0;
  page.on('download', () => {
    downloads += 1;
  });
  await panel().getByRole('button', { name: 'Bring onto the source' }).click();
  await expect(panel().getByText('Bringing it across…')).toBeVisible();
  await expect(panel().getByRole('button', { name: 'Shapes' })).toBeDisabled();
  await page.screenshot({ path: test.info().outputPath('working.png') });
  // The page can be used meanwhile.
  await openStep(page, 'map');
  await openStep(page, 'use');
  await panel().getByRole('button', { name: 'Cancel', exact: true }).click();
  await expect(panel().getByText('Bringing it across…')).toHaveCount(0);
  await page.unroute(/bring-worker/);
  await expect(panel().locator('.bring-kind')).toHaveText('dots.csv: curves on the target.');
  expect(downloads).toBe(0);
  expect((await saved('Bring onto the source')).name).toBe('dots-on-source.json');
});

test('without a map the section says what it is for', async ({ browser }) => {
  const fresh = await browser.newPage();
  await openDemo(fresh, '#demo=sphere-tetrahedron');
  await openStep(fresh, 'use');
  await expect(fresh.locator('#panel')).toContainText('Once there is a map, what belongs to one mesh can be brought onto the other');
  await fresh.close();
});
