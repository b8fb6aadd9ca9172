/**
 * Draws the icons that an installed page needs as pixels, from `www/public/icon.svg`, in the browser of the tests. To be
 * run by `npm run icons` when the drawing has changed.
 */
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { chromium } from '@playwright/test';

const FOLDER = new URL('../www/public/', import.meta.url);
const BROWSER = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Systems cut maskable icons to shapes of their own, which leave the middle 80 % for certain. */
const ICONS = [
  { file: 'icon-192.png', size: 192, share: 1, background: 'transparent' },
  { file: 'icon-512.png', size: 512, share: 1, background: 'transparent' },
  { file: 'icon-maskable-512.png', size: 512, share: 0.6, background: '#f4f2ee' },
];

const drawing = `data:image/svg+xml;base64,${readFileSync(new URL('icon.svg', FOLDER)).toString('base64')}`;
const browser = await chromium.launch(existsSync(BROWSER) ? { executablePath: BROWSER, args: ['--no-sandbox'] } : {});
try {
  const page = await browser.newPage();
  for (const { file, size, share, background } of ICONS) {
    await page.setViewportSize({ width: size, height: size });
    const side = size * share;
    await page.setContent(
      `<body style="margin:0;height:${size}px;display:grid;place-items:center;background:${background}">
        <img width="${side}" height="${side}" src="${drawing}"></body>`,
    );
    await page.locator('img').evaluate((image) => image.decode());
    writeFileSync(new URL(file, FOLDER), await page.screenshot({ omitBackground: background === 'transparent' }));
  }
} finally {
  await browser.close();
}
