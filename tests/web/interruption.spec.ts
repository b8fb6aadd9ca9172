/** Runs that end early: cancelled at any moment, or broken off. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { finished, openDemo, openStep, pairs } from './page.ts';
import { Random } from '../unit/random.ts';
import { trapping } from './trapping.ts';

const CANCELS = Number(process.env['CONEMAP_CANCELS'] ?? 50);
const SEED = Number(process.env['CONEMAP_SEED'] ?? 1);

/** Chooses a number of own cones: without a change nothing is run again. */
async function chooseOwnCones(page: Page, choice: string): Promise<void> {
  await openStep(page, 'map');
  const choices = page.getByRole('combobox', { name: 'Own cones' });
  if (!(await choices.isVisible())) {
    await page.locator('#details summary').click();
  }
  await choices.selectOption(choice);
}

test('a run can be cancelled at any moment, and the next one is whole', { tag: ['@long', '@alone'] }, async ({ page }) => {
  test.setTimeout(60_000 + 20_000 * CANCELS);
  const errors: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error') {
      errors.push(message.text());
    }
  });
  page.on('pageerror', (error) => {
    errors.push(error.message);
  });
  await openDemo(page);
  await openStep(page, 'landmarks');
  const count = await pairs(page).count();
  const begun = Date.now();
  await page.locator('#run').click();
  await finished(page);
  const whole = Date.now() - begun;
  const random = new Random(SEED);
  const waited: number[] = [];
  const choices = ['Up to 10', 'Up to 20', 'Up to 40'];
  for (let run = 0; waited.length < CANCELS; run++) {
    await chooseOwnCones(page, choices[run % choices.length] ?? '');
    await page.locator('#run').click();
    if ((await page.locator('body').getAttribute('data-state')) !== 'running') {
      // The run before reached its end, with the same choice.
      continue;
    }
    await page.waitForTimeout(random.unit() * whole);
    waited.push(
      await page.evaluate(() => {
        const from = performance.now();
        // A run that has ended meanwhile has no such button.
        document.querySelector<HTMLButtonElement>('#cancel')?.click();
        return performance.now() - from;
      }),
    );
    await expect(page.locator('body')).not.toHaveAttribute('data-state', 'running');
    await expect(page.locator('#error')).toBeHidden();
  }
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(count);
  await chooseOwnCones(page, 'None');
  await page.locator('#run').click();
  await finished(page);
  expect(errors).toEqual([]);
  waited.sort((a, b) => a - b);
  console.log(`${CANCELS} cancels within ${whole} ms: median ${waited[CANCELS >> 1]?.toFixed(0)} ms, longest ${waited.at(-1)?.toFixed(0)} ms`);
});

test('a run that breaks off is told with a report to copy, and the next one is whole', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.route(
    /\/core_bg-[^/]*\.wasm$/u,
    async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: trapping(await response.body(), 'runMap') });
    },
    { times: 1 },
  );
  await openDemo(page);
  await openStep(page, 'landmarks');
  const count = await pairs(page).count();
  await page.locator('#run').click();
  await expect(page.locator('#error')).toContainText('stopped unexpectedly', { timeout: 60_000 });
  await page.getByRole('button', { name: 'Copy a report' }).click();
  await expect(page.getByRole('button', { name: 'Copied' })).toBeVisible();
  const report = await page.evaluate(() => navigator.clipboard.readText());
  expect(report).toMatch(/^Conemap broke off\.\nFailure: (trap|worker)/u);
  expect(report).toContain('triangles');
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(count);
  // The next visit has an intact core, and the work that was there.
  await page.reload();
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  await page.locator('#run').click();
  await finished(page);
  await expect(page.getByRole('button', { name: 'Copy a report' })).toHaveCount(0);
});
