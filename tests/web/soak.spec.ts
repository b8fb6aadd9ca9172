/** Many maps in one page: the memory that the browser holds for the page does not grow. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { expect, test } from './test.ts';
import { finished, openDemo, openStep } from './page.ts';

const MAPS = Number(process.env['CONEMAP_SOAK'] ?? 40);
/** The number of maps after which the memory should no longer grow. */
const WARM = 10;

/** The memory in MiB of the largest renderer process; the page's workers are threads of it. */
function held(): number {
  const renderers = readdirSync('/proc').filter((name) => {
    try {
      return /^\d+$/.test(name) && readFileSync(`/proc/${name}/cmdline`, 'utf8').includes('--type=renderer');
    } catch {
      return false;
    }
  });
  const sizes = renderers.map((name) => Number(/VmRSS:\s*(\d+)/.exec(readFileSync(`/proc/${name}/status`, 'utf8'))?.[1] ?? 0));
  return Math.max(...sizes) / 1024;
}

test('forty maps in one page take no more memory than ten', { tag: ['@long', '@alone'] }, async ({ page }) => {
  test.skip(!existsSync('/proc/self/status'), 'this system does not tell what a process holds');
  test.setTimeout(60_000 * MAPS);
  await openDemo(page);
  await openStep(page, 'map');
  await page.locator('#details summary').click();
  const session = await page.context().newCDPSession(page);
  const [sizes, heaps]: [number[], number[]] = [[], []];
  for (let run = 0; run < MAPS; run++) {
    // Without a change nothing would be run again.
    await page.getByRole('combobox', { name: 'Own cones' }).selectOption(run % 2 === 0 ? 'None' : 'Up to 10');
    await page.locator('#run').click();
    await expect(page.locator('body')).toHaveAttribute('data-state', 'running');
    await finished(page);
    // Memory that has only not been collected yet does not count.
    await session.send('HeapProfiler.collectGarbage');
    sizes.push(Math.round(held()));
    const { usedSize } = await session.send('Runtime.getHeapUsage');
    heaps.push(Math.round(usedSize / 2 ** 20));
  }
  console.log(`MiB held after each map: ${sizes.join(' ')}`);
  console.log(`of these by scripts: ${heaps.join(' ')}`);
  const highest = (from: number, to: number): number => Math.max(...sizes.slice(from, to));
  expect(highest(MAPS - WARM, MAPS)).toBeLessThan(1.15 * highest(0, WARM));
});
