import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { LaunchOptions } from '@playwright/test';
import { defineConfig } from '@playwright/test';
import { freePort } from './free-port.ts';

const root = fileURLToPath(new URL('../../', import.meta.url));
/** A Chromium that is installed; where there is none, Playwright's own is used. */
const chromium = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

// The workers inherit the port from the first process.
process.env['CONEMAP_TEST_PORT'] ??= String(await freePort());
const address = `http://127.0.0.1:${process.env['CONEMAP_TEST_PORT']}/`;

/** Features of this browser that only take processor time from the tests. The list replaces Playwright's own, and so repeats it. */
const WITHOUT = [
  // With these features each window of a test would begin with two hidden pages for the popups of the address bar.
  ...['WebUIOmniboxPopup', 'WebUIOmniboxAimPopup', 'WebUIOmniboxFullPopup', 'AimEnabled', 'LensOverlay'],
  ...['AvoidUnnecessaryBeforeUnloadCheckSync', 'DestroyProfileOnBrowserClose', 'PaintHolding', 'ThirdPartyStoragePartitioning'],
  ...['AvoidCorsURLLoaderRestartOnRedirect', 'HttpsUpgrades', 'HttpsFirstBalancedModeAutoEnable', 'MediaRouter'],
  ...['OptimizationHints', 'NetworkTimeServiceQuerying', 'PreconnectToSearch'],
];

/** Tests that measure times: they run one after the other, after all others. */
const ALONE = /@alone/;

/** The options with which the browser starts, with further switches. */
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
  // While one test waits for a glide, the others compute: on two processors this takes 246 s instead of 275 s with two workers.
  workers: 3,
  forbidOnly: true,
  reporter: 'list',
  use: {
    baseURL: address,
    viewport: { width: 1280, height: 800 },
    actionTimeout: 60_000,
    // Most tests look at the page's own requests; tests of visits without a network allow service workers.
    serviceWorkers: 'block',
  },
  projects: [
    {
      name: 'together',
      grepInvert: ALONE,
      // Only the canvas needs the emulated graphics card, which is slow; the page around it is composited without it.
      use: { launchOptions: launched(['--disable-gpu-compositing']) },
    },
    // For measurements of time the page is composited as usual: without the card each frame of the canvas is read back, in a long task.
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
