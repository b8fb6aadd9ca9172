/** The colours and pictures of the user's own files, and how the map carries them. */
import { zipSync } from 'fflate';
import type { Page } from '@playwright/test';
import { expect, test } from '@playwright/test';
import { halvesPicture, seen } from './canvas.ts';
import type { OwnFiles } from './own-files.ts';
import { ownFiles } from './own-files.ts';
import { dropContents, open, openStep, ROOT, runMap, showSurface } from './page.ts';

const own: OwnFiles = ownFiles();

interface Shape {
  readonly text: string;
  readonly vertices: readonly (readonly [number, number, number])[];
  /** Least and greatest number along the longest way. */
  readonly range: readonly [number, number];
  readonly axis: number;
}

/** An OBJ file's vertices and the axis along which it is longest. */
function shapeOf(text: string): Shape {
  const vertices = [...text.matchAll(/^v (\S+) (\S+) (\S+)/gm)].map(([, x, y, z]) => [Number(x), Number(y), Number(z)] as const);
  const ranges = [0, 1, 2].map((k) => {
    const values = vertices.map((v) => v[k] ?? 0);
    return [Math.min(...values), Math.max(...values)] as const;
  });
  const lengths = ranges.map(([low, high]) => high - low);
  const axis = lengths.indexOf(Math.max(...lengths));
  return { text, vertices, range: ranges[axis] ?? [0, 1], axis };
}

/** From 0 at one end to 1 at the other. */
function along({ range: [low, high], axis }: Shape, v: readonly number[]): number {
  return ((v[axis] ?? 0) - low) / (high - low);
}

/** The file with a colour at each vertex: red in front, blue behind. */
function coloured(text: string): string {
  const shape = shapeOf(text);
  return text.replace(/^v (\S+) (\S+) (\S+)/gm, (line, x: string, y: string, z: string) =>
    along(shape, [Number(x), Number(y), Number(z)]) < 0.5 ? `${line} 1 0 0` : `${line} 0 0 1`,
  );
}

/** The file with a place in a picture at each corner: from left to right along the mesh. */
function placed(text: string): string {
  const shape = shapeOf(text);
  const places = shape.vertices.map((v) => `vt ${0.02 + 0.96 * along(shape, v)} 0.5`).join('\n');
  const faces = text.replace(/^f (\S+) (\S+) (\S+)/gm, 'f $1/$1 $2/$2 $3/$3');
  return `mtllib cat.mtl\n${faces.replace(/^f /m, `${places}\nusemtl skin\nf `)}`;
}

/** A picture whose left half is green and whose right half is red. */
function picture(page: Page): Promise<Buffer> {
  return halvesPicture(page, ['#00d000', '#e00000'], [64, 16]);
}

async function dropped(page: Page, files: readonly { name: string; content: Buffer | string }[]): Promise<void> {
  await dropContents(page, files);
  await expect(page.locator('body')).toHaveAttribute('data-pairs', String(own.pairs));
}

const landmarks = { name: own.landmarks.name, content: own.landmarks.buffer };

test('colours of a file are seen, and the map carries them', async ({ page }) => {
  await open(page);
  await dropped(page, [
    { name: 'horse.obj', content: own.horse.buffer },
    { name: 'cat.obj', content: coloured(own.cat.buffer.toString()) },
    landmarks,
  ]);
  await expect(page.getByRole('button', { name: 'Picture: Own colours' })).toBeVisible();
  await expect.poll(async () => (await seen(page, 'target')).red).toBeGreaterThan(0.01);
  const before = [await seen(page, 'source'), await seen(page, 'target')];
  expect(before[0]?.red).toBeLessThan(0.002);
  expect(before[1]?.blue).toBeGreaterThan(0.01);
  await openStep(page, 'map');
  await runMap(page);
  await page.screenshot({ path: `${ROOT}test-results/look-colours.png` });
  const source = await seen(page, 'source');
  expect(source.red).toBeGreaterThan(0.01);
  expect(source.blue).toBeGreaterThan(0.01);
  await showSurface(page, 'Plain');
  expect((await seen(page, 'source')).red).toBeLessThan(0.002);
  await showSurface(page, 'Own colours');
  expect((await seen(page, 'source')).red).toBeGreaterThan(0.01);
});

test('a picture that an OBJ file’s material names lies on it, from a zip too', async ({ page }) => {
  await open(page);
  const png = await picture(page);
  const set = {
    'cat.obj': Buffer.from(placed(own.cat.buffer.toString())),
    'cat.mtl': Buffer.from('newmtl skin\nKd 1 1 1\nmap_Kd -s 1 1 1 coat.png\n'),
    'coat.png': png,
  };
  await dropped(page, [
    { name: 'horse.obj', content: own.horse.buffer },
    { name: 'cat.zip', content: Buffer.from(zipSync(set)) },
    landmarks,
  ]);
  await expect.poll(async () => (await seen(page, 'target')).green).toBeGreaterThan(0.01);
  expect((await seen(page, 'target')).red).toBeGreaterThan(0.01);
  await openStep(page, 'map');
  await runMap(page);
  await page.screenshot({ path: `${ROOT}test-results/look-picture.png` });
  const source = await seen(page, 'source');
  expect(source.green).toBeGreaterThan(0.01);
  expect(source.red).toBeGreaterThan(0.01);
});

test('colours of the source are carried where the target has none; files without any stay plain', async ({ page }) => {
  await open(page);
  await dropped(page, [
    { name: 'horse.obj', content: coloured(own.horse.buffer.toString()) },
    { name: 'cat.obj', content: own.cat.buffer },
    landmarks,
  ]);
  await openStep(page, 'map');
  await runMap(page);
  const target = await seen(page, 'target');
  expect(target.red).toBeGreaterThan(0.01);
  expect(target.blue).toBeGreaterThan(0.01);
  await dropped(page, [
    { name: 'horse.obj', content: own.horse.buffer },
    { name: 'cat.obj', content: own.cat.buffer },
    landmarks,
  ]);
  await page.getByRole('button', { name: /^Picture: / }).click();
  await expect(page.getByRole('radio', { name: 'Own colours' })).toBeDisabled();
});
