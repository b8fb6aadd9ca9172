import { existsSync } from 'node:fs';
import { createServer } from 'node:net';
import { fileURLToPath } from 'node:url';
import { defineConfig } from '@playwright/test';

const root = fileURLToPath(new URL('../../', import.meta.url));
/** A Chromium that is there; without one, Playwright's own. */
const chromium = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

/** A port that nobody listens on; the workers inherit the first choice. */
async function freePort(): Promise<string> {
  return new Promise((resolve, reject) => {
    const server = createServer();
    server.once('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const address = server.address();
      server.close(() => {
        if (address === null || typeof address === 'string') {
          reject(new Error('no free port'));
        } else {
          resolve(String(address.port));
        }
      });
    });
  });
}

process.env['CONEMAP_TEST_PORT'] ??= await freePort();
const address = `http://127.0.0.1:${process.env['CONEMAP_TEST_PORT']}/`;

export default defineConfig({
  testDir: '.',
  outputDir: `${root}test-results/artifacts`,
  timeout: 300_000,
  globalTimeout: 1_200_000,
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
