/**
 * Draws the pictures of docs/figures.md that stand beside the figures of the thesis, with the page itself, as docs/figures/NAME.webp. Run
 * it by `npm run figures` after `cargo xtask build`, when what the pictures show has changed; `npm run figures -- NAME` draws only the
 * named ones.
 */
import { mkdirSync, writeFileSync } from 'node:fs';
import { exportedPicture, openMapped, PATIENCE, ROOT, withPage } from './page-in-browser.mjs';

const FOLDER = `${ROOT}docs/figures`;
/** The longer side of a picture, in pixels. */
const LONGEST = 960;
/** The most bytes of a picture's file. */
const LARGEST = 40_000;

/** Chooses what the surfaces show. */
async function surface(page, name) {
  await page.getByRole('button', { name: /^Picture: / }).click();
  await page.getByRole('radio', { name, exact: true }).check();
  await page.keyboard.press('Escape');
  await page.waitForTimeout(800);
}

/** Switches on one of the lines that are drawn on the surfaces. */
async function onIt(page, name) {
  await page.getByRole('checkbox', { name }).check();
  await page.waitForTimeout(500);
}

/** A function that takes a picture of the views in a style. */
const inStyle = (name) => async (page) => {
  await surface(page, name);
  return exportedPicture(page);
};

/** The same for a heat map that must wait for both flows. */
const ofFlows = (name) => async (page) => {
  await surface(page, name);
  await page.locator('.legend .scale').waitFor({ timeout: PATIENCE });
  await page.waitForTimeout(800);
  return exportedPicture(page);
};

/** A picture of a tile with a face in it, to be laid on the flat metric. */
async function tile(page) {
  const url = await page.evaluate(() => {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 256;
    const context = canvas.getContext('2d');
    const disc = (x, y, radius, colour) => {
      context.fillStyle = colour;
      context.beginPath();
      context.arc(x, y, radius, 0, 7);
      context.fill();
    };
    context.fillStyle = '#2a6f97';
    context.fillRect(0, 0, 256, 256);
    disc(128, 128, 104, '#ffd166');
    disc(92, 104, 14, '#222');
    disc(164, 104, 14, '#222');
    context.lineWidth = 12;
    context.beginPath();
    context.arc(128, 130, 56, 0.3, 2.84);
    context.stroke();
    return canvas.toDataURL('image/png');
  });
  return Buffer.from(url.slice(url.indexOf(',') + 1), 'base64');
}

async function ownPicture(page) {
  await page.locator('#texture-file').setInputFiles({ name: 'tile.png', mimeType: 'image/png', buffer: await tile(page) });
  await page.getByRole('button', { name: 'Picture: Your picture' }).waitFor();
  await page.waitForTimeout(800);
  return exportedPicture(page);
}

async function patchLines(page) {
  await surface(page, 'Plain');
  await onIt(page, 'Patch lines');
  await onIt(page, 'Cones');
  const picture = await exportedPicture(page);
  await page.getByRole('checkbox', { name: 'Patch lines' }).uncheck();
  await page.getByRole('checkbox', { name: 'Cones' }).uncheck();
  return picture;
}

async function baseDomain(page) {
  const drawing = page.locator('#base-picture');
  await drawing.scrollIntoViewIfNeeded();
  await drawing.waitFor();
  return drawing.screenshot();
}

async function plane(page) {
  await page.locator('#open-plane').click();
  const planes = page.locator('.planes');
  await planes.waitFor({ timeout: PATIENCE });
  // The layout grows ring by ring.
  await page.waitForTimeout(8000);
  const picture = await planes.screenshot();
  await page.locator('#close-plane').click();
  return picture;
}

/** Compares the map on the page with the thesis' map with equal cones. */
async function compared(page) {
  await surface(page, 'Checkerboard');
  await page.getByRole('radio', { name: 'Equal cones', exact: true }).check();
  await page.locator('#end-comparison').waitFor({ timeout: PATIENCE });
  await page.waitForTimeout(1500);
  const picture = await exportedPicture(page);
  await page.locator('#end-comparison').click();
  return picture;
}

/** The pictures that are taken of each demo's map, in this order. */
const FIGURES = {
  'sphere-tetrahedron': [['sphere-tetrahedron', inStyle('Pattern')]],
  'ball-cone': [['texture-boundary', exportedPicture]],
  'horse-camel': [
    ['base-domain', baseDomain],
    ['patch-lines', patchLines],
    ['plane', plane],
    ['checkerboard', inStyle('Checkerboard')],
    ['circles', inStyle('Circles')],
    ['ribbons', inStyle('Ribbons')],
    ['coordinates', inStyle('Coordinates')],
    ['own-picture', ownPicture],
    ['distortion', inStyle('Distortion')],
    ['areas', inStyle('Areas')],
    ['conformal-factor', ofFlows('Conformal factor')],
    ['curvature', ofFlows('Curvature')],
    ['equal-cones', compared],
  ],
};

/** Makes a smaller picture of a PNG; it runs in the page. */
async function packed(base64, longest, largest) {
  const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
  const scale = Math.min(1, longest / Math.max(bitmap.width, bitmap.height));
  const canvas = new OffscreenCanvas(Math.round(scale * bitmap.width), Math.round(scale * bitmap.height));
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  for (let quality = 0.9; ; quality -= 0.1) {
    const blob = await canvas.convertToBlob({ type: 'image/webp', quality });
    if (blob.size <= largest || quality < 0.2) {
      return [...new Uint8Array(await blob.arrayBuffer())];
    }
  }
}

await withPage(async (page, address) => {
  mkdirSync(FOLDER, { recursive: true });
  const named = process.argv.slice(2);
  const isWanted = ([name]) => named.length === 0 || named.includes(name);
  for (const [demo, figures] of Object.entries(FIGURES).filter(([, list]) => list.some(isWanted))) {
    await openMapped(page, address, demo);
    for (const [name, take] of figures.filter(isWanted)) {
      const picture = (await take(page)).toString('base64');
      const bytes = Buffer.from(await page.evaluate(`(${packed})(${JSON.stringify(picture)}, ${LONGEST}, ${LARGEST})`));
      writeFileSync(`${FOLDER}/${name}.webp`, bytes);
      process.stdout.write(`${name}.webp: ${bytes.length} bytes\n`);
    }
  }
}, { width: 1280, height: 600 });
