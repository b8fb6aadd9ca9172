/** A run that is asked to finish early. */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { DATA, finished, LONG_RUN, needsSharedData, openDemo, openStep, pairs } from './page.ts';

/** What the status line showed at one time. */
interface Said {
  readonly sentence: string;
  /** The number that the run lowers. */
  readonly number: string;
  readonly finishable: boolean;
}

/** The energy that is shown with the result. */
async function energyOf(page: Page): Promise<number> {
  await finished(page);
  await expect(page.locator('#result')).toContainText(/Certified bijective.*: 0 of [\d,]+ triangles flipped/);
  return Number(/Energy([\d.]+)/.exec((await page.locator('#details').textContent()) ?? '')?.[1]);
}

test('Finish now gives a certified map that is marked as finished early', async ({ page }) => {
  await openDemo(page, LONG_RUN);
  await page.locator('#run').click();
  await page.locator('#finish').click();
  await expect(page.locator('#finish')).toBeHidden();
  const early = await energyOf(page);
  await expect(page.locator('#result')).toContainText('Certified bijective (finished early)');
  await expect(page.locator('#result .warning').first()).toContainText('Finished early on request, at energy');

  await page.evaluate(() => {
    // A relaxation may be too short to be observed from outside, so everything that the line shows is recorded.
    const said: Said[] = [];
    Reflect.set(window, 'said', said);
    const line = document.querySelector('#status-line');
    const textOf = (name: string): string => line?.querySelector(name)?.textContent ?? '';
    const note = (): void => {
      const finishable = line?.querySelector<HTMLElement>('#finish')?.hidden === false;
      said.push({ sentence: textOf('#status'), number: textOf('.residual'), finishable });
    };
    if (line !== null) {
      new MutationObserver(note).observe(line, { childList: true, characterData: true, subtree: true });
    }
  });
  await page.locator('#run').click();
  const full = await energyOf(page);
  await expect(page.locator('#result')).not.toContainText('finished early');
  expect(full).toBeLessThan(early);
  // The button is offered only as long as the run can be shortened.
  const said = await page.evaluate(() => Reflect.get(window, 'said') as Said[]);
  const relaxing = said.filter(({ sentence }) => sentence.startsWith('Relaxing'));
  expect(relaxing.some(({ number }) => /^Energy \d\.\d+ .*, level \d$/.test(number))).toBe(true);
  expect(relaxing.some(({ finishable }) => finishable)).toBe(true);
  const late = said.filter(({ sentence }) => /^(Checking|Carrying)/.test(sentence));
  expect(late.length).toBeGreaterThan(1);
  expect(late.some(({ finishable }) => finishable)).toBe(false);
});

test('a run on real meshes finishes when asked during its relaxation', { tag: '@long' }, async ({ page }) => {
  needsSharedData();
  await openDemo(page, '');
  await page.locator('#source-file').setInputFiles(`${DATA}/sumner/horse.off`);
  await expect(page.locator('#view-source')).toContainText('horse.off');
  await page.locator('#target-file').setInputFiles(`${DATA}/sumner/camel.off`);
  await expect(page.locator('#view-target')).toContainText('camel.off');
  await page.locator('#landmark-file').setInputFiles(`${DATA}/pairs/horse-camel.json`);
  await openStep(page, 'landmarks');
  await expect(pairs(page)).toHaveCount(33, { timeout: 60_000 });
  await page.locator('#run').click();
  await expect(page.locator('.energy-curve')).toBeVisible({ timeout: 120_000 });
  // Every level has a piece of its own, and each piece falls: y points down.
  await expect(page.locator('.energy-curve line').first()).toBeAttached({ timeout: 120_000 });
  const pieces = await page.locator('.energy-curve polyline').evaluateAll((lines) => lines.map((line) => line.getAttribute('points') ?? ''));
  expect(pieces.length).toBeGreaterThan(1);
  for (const piece of pieces) {
    const heights = piece.split(' ').map((corner) => Number(corner.split(',')[1]));
    expect(heights).toEqual([...heights].sort((a, b) => a - b));
  }
  await expect(page.locator('.residual')).toContainText(/Energy [\d.]+ \(4 is the least\), level \d/);
  await page.locator('#finish').click();
  expect(await energyOf(page)).toBeLessThan(5);
  await expect(page.locator('#result')).toContainText('Certified bijective (finished early)');
});
