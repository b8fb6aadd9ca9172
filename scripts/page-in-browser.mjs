/** The built page in a browser, for scripts that draw pictures with it. */
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium } from '@playwright/test';
import { preview } from 'vite';

export const ROOT = fileURLToPath(new URL('../', import.meta.url));
const SYSTEM_CHROMIUM = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
/** The longest time that a map may take, in ms. */
export const PATIENCE = 300_000;

/** Serves the built page, and calls `work` with an empty tab and the page's address. */
export async function withPage(work, viewport = { width: 1280, height: 800 }) {
  const server = await preview({ root: ROOT, preview: { host: '127.0.0.1', port: 4179 }, logLevel: 'warn' });
  const browser = await chromium.launch({
    ...(existsSync(SYSTEM_CHROMIUM) ? { executablePath: SYSTEM_CHROMIUM } : {}),
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  try {
    const [address] = server.resolvedUrls.local;
    await work(await browser.newPage({ viewport }), address);
  } finally {
    await browser.close();
    await server.close();
  }
}

/** Opens a demo, maps it, and leaves the step Method open, with the landmarks hidden. */
export async function openMapped(page, address, demo) {
  await page.goto('about:blank');
  await page.goto(`${address}#demo=${encodeURIComponent(demo)}`);
  await page.locator(`body[data-ready="true"][data-demo="${demo}"]`).waitFor({ timeout: PATIENCE });
  await page.locator('#run').click();
  await page.locator('body[data-state="done"]').waitFor({ timeout: PATIENCE });
  await page.locator('#step-method').click();
  await page.getByRole('checkbox', { name: 'Landmarks' }).uncheck();
}

/** The page's picture of both views, as PNG. */
export async function exportedPicture(page) {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Export', exact: true }).click();
  await page.getByRole('button', { name: 'Picture of the views' }).click();
  return readFileSync(await (await download).path());
}
