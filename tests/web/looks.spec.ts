/** The colours and pictures of the user's own files, and how the map carries them. */
import { zipSync } from 'fflate';
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { halvesPicture, seen } from './canvas.ts';
import type { OwnFiles } from './own-files.ts';
import { ownFiles } from './own-files.ts';
import { glbOf, glbFaults, savedFile } from './glb.ts';
import { dropContents, open, openStep, ROOT, runMap, showSurface } from './page.ts';

const own: OwnFiles = ownFiles();

interface Shape {
  readonly text: string;
  readonly vertices: readonly (readonly [number, number, number])[];
  /** The least and the greatest coordinate along the axis. */
  readonly range: readonly [number, number];
  readonly axis: number;
}

/** The vertices of an OBJ file, and the axis along which it is longest. */
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

/** The place along the axis, from 0 at one end to 1 at the other. */
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

/** The file with texture coordinates at each corner: from left to right along the mesh. */
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

test('colours of the source are carried where the target has none; files without any stay plain', { tag: '@long' }, async ({ page }) => {
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

/** The file with a material on either half, and texture coordinates into that material's picture at every corner. */
function halved(text: string): string {
  const shape = shapeOf(text);
  const places = shape.vertices.map((v) => `vt ${0.02 + 0.96 * along(shape, v)} 0.5`).join('\n');
  const isFront = (number: string): boolean => along(shape, shape.vertices[Number(number) - 1] ?? []) < 0.5;
  const faces = text.replace(/^f (\S+) (\S+) (\S+)/gm, (_, a: string, b: string, c: string) =>
    `usemtl ${isFront(a) ? 'front' : 'back'}\nf ${a}/${a} ${b}/${b} ${c}/${c}`,
  );
  return `mtllib cat.mtl\n${faces.replace(/^usemtl /m, `${places}\nusemtl `)}`;
}

const MATERIALS = 'newmtl front\nmap_Kd front.png\nnewmtl back\nmap_Kd back.png\n';

/** A picture of one colour. */
function plain(page: Page, colour: string): Promise<Buffer> {
  return halvesPicture(page, [colour, colour], [16, 16]);
}

/** The mesh as GLB with two primitives, each with its own material and picture. */
function twoPictures(text: string, pictures: readonly [Buffer, Buffer]): Buffer {
  const shape = shapeOf(text);
  const faces = [...text.matchAll(/^f (\S+) (\S+) (\S+)/gm)].map(([, ...corners]) => corners.map((corner) => Number(corner) - 1));
  const isFront = (face: readonly number[]): boolean => along(shape, shape.vertices[face[0] ?? 0] ?? []) < 0.5;
  const numbers = (values: readonly number[]): Buffer => Buffer.from(Float32Array.from(values).buffer);
  const indices = (front: boolean): Buffer => Buffer.from(Uint32Array.from(faces.filter((face) => isFront(face) === front).flat()).buffer);
  const contents = [numbers(shape.vertices.flat()), numbers(shape.vertices.flatMap((v) => [along(shape, v), 0.5])), indices(true), indices(false), ...pictures];
  const padded = contents.map((content) => Buffer.concat([content, Buffer.alloc((4 - (content.length % 4)) % 4)]));
  const begins = padded.map((_, k) => padded.slice(0, k).reduce((sum, { length }) => sum + length, 0));
  const count = shape.vertices.length;
  const material = (index: number): object => ({ pbrMetallicRoughness: { baseColorTexture: { index } } });
  const primitive = (k: number): object => ({ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2 + k, material: k });
  const document = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [primitive(0), primitive(1)] }],
    materials: [material(0), material(1)],
    textures: [{ source: 0 }, { source: 1 }],
    images: [4, 5].map((bufferView) => ({ bufferView, mimeType: 'image/png' })),
    accessors: [
      { bufferView: 0, componentType: 5126, count, type: 'VEC3' },
      { bufferView: 1, componentType: 5126, count, type: 'VEC2' },
      ...[2, 3].map((bufferView) => ({ bufferView, componentType: 5125, count: (contents[bufferView]?.length ?? 0) / 4, type: 'SCALAR' })),
    ],
    bufferViews: contents.map(({ length }, k) => ({ buffer: 0, byteOffset: begins[k], byteLength: length })),
    buffers: [{ byteLength: padded.reduce((sum, { length }) => sum + length, 0) }],
  };
  return glbOf(document, Buffer.concat(padded));
}

/** Checks that both colours are visible on the target at once. */
async function expectBoth(page: Page, view: 'source' | 'target'): Promise<void> {
  await expect
    .poll(async () => {
      const { red, green } = await seen(page, view);
      return Math.min(red, green);
    })
    .toBeGreaterThan(0.01);
}

test('a GLB with two pictures is seen with both, and the GLB of its map has both, byte for byte', { tag: '@long' }, async ({ page }) => {
  await open(page);
  const pictures = [await plain(page, '#00d000'), await plain(page, '#e00000')] as const;
  const cat = twoPictures(own.cat.buffer.toString(), pictures);
  await dropped(page, [{ name: 'horse.obj', content: own.horse.buffer }, { name: 'cat.glb', content: cat }, { ...landmarks, content: landmarks.content.toString().replace('cat.obj', 'cat.glb') }]);
  await expectBoth(page, 'target');
  await openStep(page, 'map');
  await runMap(page);
  await expectBoth(page, 'source');
  await page.screenshot({ path: `${ROOT}test-results/look-two-pictures.png` });
  await openStep(page, 'use');
  for (const button of ['GLB', 'Morph']) {
    const { bytes, document, view } = await savedFile(page, button);
    expect(document.meshes[0]?.primitives).toHaveLength(2);
    const images = (document.images ?? []).map(({ bufferView }) => view(bufferView));
    expect(images.map((image) => pictures.findIndex((picture) => picture.equals(image)))).toEqual([0, 1]);
    expect(await glbFaults(bytes)).toEqual([]);
  }
});

test('materials of an OBJ file with two pictures are seen, from a zip too, and kept over a reload', { tag: '@long' }, async ({ page }) => {
  await open(page);
  const set = {
    'cat.obj': Buffer.from(halved(own.cat.buffer.toString())),
    'cat.mtl': Buffer.from(MATERIALS),
    'front.png': await plain(page, '#00d000'),
    'back.png': await plain(page, '#e00000'),
  };
  const loose = Object.entries(set).map(([name, content]) => ({ name, content }));
  await dropped(page, [{ name: 'horse.obj', content: own.horse.buffer }, ...loose, landmarks]);
  await expectBoth(page, 'target');
  await page.reload();
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
  await expect(page.locator('#view-target')).toContainText('cat.obj');
  await expectBoth(page, 'target');
  await dropped(page, [{ name: 'horse.obj', content: own.horse.buffer }, { name: 'cat.zip', content: Buffer.from(zipSync(set)) }, landmarks]);
  await expectBoth(page, 'target');
  await openStep(page, 'map');
  await runMap(page);
  await openStep(page, 'use');
  const { bytes, document, view } = await savedFile(page, 'GLB');
  const images = (document.images ?? []).map(({ bufferView }) => view(bufferView));
  expect(images.map((image) => image.equals(set['front.png']) || image.equals(set['back.png']))).toEqual([true, true]);
  expect(await glbFaults(bytes)).toEqual([]);
});

test('pictures that cannot be shown are told, and the mesh and the other pictures stay', async ({ page }) => {
  await open(page);
  const mesh = { name: 'cat.obj', content: halved(own.cat.buffer.toString()) };
  const materials = { name: 'cat.mtl', content: MATERIALS };
  const back = { name: 'back.png', content: await plain(page, '#e00000') };
  const horse = { name: 'horse.obj', content: own.horse.buffer };
  const error = page.locator('#error');
  // One picture is missing.
  await dropped(page, [horse, mesh, materials, back, landmarks]);
  await expect(error).toContainText('cat.obj: The picture front.png is missing');
  await expect.poll(async () => (await seen(page, 'target')).red).toBeGreaterThan(0.01);
  // One file is not a picture.
  await dropped(page, [horse, mesh, materials, back, { name: 'front.png', content: '<script>' }, landmarks]);
  await expect(error).toContainText('cat.obj: The picture front.png is no PNG, JPEG or WebP file');
  // One file begins like a picture, but the browser cannot decode it.
  await dropped(page, [horse, mesh, materials, back, { name: 'front.png', content: back.content.subarray(0, 40) }, landmarks]);
  await expect(error).toContainText('cat.obj: this browser cannot decode 1 picture of it');
  await expect.poll(async () => (await seen(page, 'target')).red).toBeGreaterThan(0.01);
  // Texture coordinates that are not numbers.
  const nowhere = { ...mesh, content: mesh.content.replace(/^vt \S+/m, 'vt nan') };
  await dropped(page, [horse, nowhere, materials, back, { ...back, name: 'front.png' }, landmarks]);
  await expect(error).toContainText('cat.obj: Its colours are incomplete: line');
  await expect(page.locator('#run')).toBeEnabled();
});

test('a picture larger than the graphics card takes is made smaller', async ({ page }) => {
  await open(page);
  const large = await halvesPicture(page, ['#00d000', '#e00000'], [12_000, 4]);
  const set = [
    { name: 'cat.obj', content: placed(own.cat.buffer.toString()) },
    { name: 'cat.mtl', content: 'newmtl skin\nmap_Kd coat.png\n' },
    { name: 'coat.png', content: large },
  ];
  await dropped(page, [{ name: 'horse.obj', content: own.horse.buffer }, ...set, landmarks]);
  await expectBoth(page, 'target');
  await expect(page.locator('#error')).toBeHidden();
});
