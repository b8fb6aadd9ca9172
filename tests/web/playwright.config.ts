import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { LaunchOptions } from '@playwright/test';
import { defineConfig } from '@playwright/test';
import { freePort } from './free-port.ts';

const root = fileURLToPath(new URL('../../', import.meta.url));
/** A Chromium that is there; without one, Playwright's own. */
const chromium = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

// The workers inherit the first choice.
process.env['CONEMAP_TEST_PORT'] ??= String(await freePort());
const address = `http://127.0.0.1:${process.env['CONEMAP_TEST_PORT']}/`;

/** What this browser does for itself, and takes processor time with. The list is in place of Playwright's own, and repeats it. */
const WITHOUT = [
  // Each window of a test would begin with two hidden pages: the popups of the address bar.
  ...['WebUIOmniboxPopup', 'WebUIOmniboxAimPopup', 'WebUIOmniboxFullPopup', 'AimEnabled', 'LensOverlay'],
  ...['AvoidUnnecessaryBeforeUnloadCheckSync', 'DestroyProfileOnBrowserClose', 'PaintHolding', 'ThirdPartyStoragePartitioning'],
  ...['AvoidCorsURLLoaderRestartOnRedirect', 'HttpsUpgrades', 'HttpsFirstBalancedModeAutoEnable', 'MediaRouter'],
  ...['OptimizationHints', 'NetworkTimeServiceQuerying', 'PreconnectToSearch'],
];

/** Tests that measure times: they run one after the other, when the rest is done. */
const ALONE = /@alone/;

/** How the browser starts, with further switches. */
function launched(switches: readonly string[]): LaunchOptions {
  return {
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
      `--disable-features=${WITHOUT.join(',')}`,
      ...switches,
    ],
  };
}

export default defineConfig({
  testDir: '.',
  outputDir: `${root}test-results/artifacts`,
  timeout: 300_000,
  globalTimeout: 2_400_000,
  expect: { timeout: 30_000 },
  // While the one waits for what glides, the others compute: on two processors 246 s in place of 275 with two of them.
  workers: 3,
  forbidOnly: true,
  reporter: 'list',
  use: {
    baseURL: address,
    viewport: { width: 1280, height: 800 },
    actionTimeout: 60_000,
    // The page's own requests are what most tests look at; those of visits without a network allow it.
    serviceWorkers: 'block',
  },
  projects: [
    {
      name: 'together',
      grepInvert: ALONE,
      // Only the canvas needs the emulated graphics card, which is slow: the page around it is put together without.
      use: { launchOptions: launched(['--disable-gpu-compositing']) },
    },
    // What measures times has the page put together as usual: without the card each frame of the canvas is read back, in a long task.
    { name: 'alone', grep: ALONE, use: { launchOptions: launched([]) } },
  ],
  webServer: {
    command: `npx vite preview --host 127.0.0.1 --port ${process.env['CONEMAP_TEST_PORT']} --strictPort`,
    cwd: root,
    url: address,
    timeout: 60_000,
    reuseExistingServer: false,
  },
});
