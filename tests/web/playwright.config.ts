import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from '@playwright/test';
import { freePort } from './free-port.ts';

const root = fileURLToPath(new URL('../../', import.meta.url));
/** A Chromium that is there; without one, Playwright's own. */
const chromium = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

// The workers inherit the first choice.
process.env['CONEMAP_TEST_PORT'] ??= String(await freePort());
const address = `http://127.0.0.1:${process.env['CONEMAP_TEST_PORT']}/`;

export default defineConfig({
  testDir: '.',
  outputDir: `${root}test-results/artifacts`,
  timeout: 300_000,
  globalTimeout: 2_400_000,
  expect: { timeout: 30_000 },
  workers: 1,
  forbidOnly: true,
  reporter: 'list',
  use: {
    baseURL: address,
    viewport: { width: 1280, height: 800 },
    actionTimeout: 60_000,
    // The page's own requests are what most tests look at; those of visits without a network allow it.
    serviceWorkers: 'block',
    launchOptions: {
      ...(existsSync(chromium) ? { executablePath: chromium } : {}),
      args: [
        '--no-sandbox',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
      ],
    },
  },
  webServer: {
    command: `npx vite preview --host 127.0.0.1 --port ${process.env['CONEMAP_TEST_PORT']} --strictPort`,
    cwd: root,
    url: address,
    timeout: 60_000,
    reuseExistingServer: false,
  },
});
