/**
 * Draws the pictures of the demos in the gallery, with the page itself: it maps each demo in a browser and saves what both views show,
 * without their ground, as www/public/demos/NAME.webp. Run it by `npm run thumbnails` after `npm run build`, when the demos or the way in
 * which they are drawn have changed; `npm run thumbnails -- NAME` draws only the named ones.
 */
import { mkdirSync, writeFileSync } from 'node:fs';
import { exportedPicture, openMapped, PATIENCE, ROOT, withPage } from './page-in-browser.mjs';

const FOLDER = `${ROOT}www/public/demos`;
/** The size of a picture in pixels, twice that on the page. */
const SIZE = { width: 480, height: 200 };
/** The most bytes of a picture's file. */
const LARGEST = 12_000;

/** The page's picture of the views, in base64. */
async function exported(page, colorScheme) {
  await page.emulateMedia({ colorScheme });
  // The views follow the theme with their next frame.
  await page.waitForTimeout(1000);
  return (await exportedPicture(page)).toString('base64');
}

/** Maps a demo; returns the page's pictures of it in light and in dark. */
async function mapped(page, address, demo) {
  await openMapped(page, address, demo);
  return [await exported(page, 'light'), await exported(page, 'dark')];
}

/**
 * Composes the picture of a demo; it runs in the page. One picture has a light ground and the other a dark one: their difference shows how
 * much of the ground is visible at each pixel, and the rest is the body. Each half is cut to its body, and both are put side by side.
 */
async function composed([light, dark], { width, height }, largest) {
  const pixels = async (base64) => {
    const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height);
  };
  const [a, b] = [await pixels(light), await pixels(dark)];
  const grounds = [a, b].map(({ data }) => [...data.subarray(0, 3)]);
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const contrast = mean(grounds[0]) - mean(grounds[1]);
  const body = new OffscreenCanvas(a.width, a.height);
  const image = new ImageData(a.width, a.height);
  for (let k = 0; k < a.data.length; k += 4) {
    const seen = (mean([...a.data.subarray(k, k + 3)]) - mean([...b.data.subarray(k, k + 3)])) / contrast;
    const opacity = Math.min(1, Math.max(0, 1 - seen));
    for (let channel = 0; channel < 3; channel++) {
      image.data[k + channel] = opacity < 0.02 ? 0 : (a.data[k + channel] - (1 - opacity) * grounds[0][channel]) / opacity;
    }
    image.data[k + 3] = opacity < 0.02 ? 0 : 255 * opacity;
  }
  body.getContext('2d').putImageData(image, 0, 0);
  /** The smallest box around the body in the columns from `left` up to, but without, `right`. */
  const box = (left, right) => {
    const found = { left: right, right: left, top: a.height, bottom: 0 };
    for (let y = 0; y < a.height; y++) {
      for (let x = left; x < right; x++) {
        if (image.data[4 * (y * a.width + x) + 3] > 128) {
          found.left = Math.min(found.left, x);
          found.right = Math.max(found.right, x + 1);
          found.top = Math.min(found.top, y);
          found.bottom = Math.max(found.bottom, y + 1);
        }
      }
    }
    return found;
  };
  const middle = Math.floor(a.width / 2);
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  [box(0, middle), box(middle, a.width)].forEach(({ left, right, top, bottom }, side) => {
    const [w, h] = [right - left, bottom - top];
    const room = { width: width / 2 - 24, height: height - 16 };
    const scale = Math.min(room.width / w, room.height / h);
    const x = (side + 0.5) * (width / 2) - (w * scale) / 2;
    context.drawImage(body, left, top, w, h, x, (height - h * scale) / 2, w * scale, h * scale);
  });
  for (let quality = 0.9; ; quality -= 0.1) {
    const blob = await canvas.convertToBlob({ type: 'image/webp', quality });
    if (blob.size <= largest || quality < 0.2) {
      return [...new Uint8Array(await blob.arrayBuffer())];
    }
  }
}

await withPage(async (page, address) => {
  await page.goto(address);
  await page.locator('body[data-ready="true"]').waitFor({ timeout: PATIENCE });
  await page.locator('#step-meshes').click();
  const demos = await page.locator('[data-demo-id]').evaluateAll((buttons) => buttons.map((button) => button.dataset.demoId));
  mkdirSync(FOLDER, { recursive: true });
  const named = process.argv.slice(2);
  for (const demo of demos.filter((id) => named.length === 0 || named.includes(id))) {
    const pictures = await mapped(page, address, demo);
    const source = `(${composed})(${JSON.stringify(pictures)}, ${JSON.stringify(SIZE)}, ${LARGEST})`;
    const bytes = Buffer.from(await page.evaluate(source));
    writeFileSync(`${FOLDER}/${demo}.webp`, bytes);
    process.stdout.write(`${demo}.webp: ${bytes.length} bytes\n`);
  }
});
