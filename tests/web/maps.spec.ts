/** Finished maps that are opened from their files look as after the run, and nothing is computed. */
import { readFileSync } from 'node:fs';
import type { BrowserContext, Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { unzipSync } from 'fflate';
import { bothDecoded } from './canvas.ts';
import { dropContents, fail, finished, open, openDemo, openStep, pairs, showSurface, TETRAHEDRON } from './page.ts';

interface Saved {
  readonly name: string;
  readonly content: Buffer;
}

async function downloaded(page: Page, button: string): Promise<Saved> {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: button, exact: true }).click();
  const file = await download;
  return { name: file.suggestedFilename(), content: readFileSync(await file.path()) };
}

/** The texts of the step Map about the map: the verdict, the proof, and all numbers. */
async function told(page: Page): Promise<string[]> {
  await openStep(page, 'map');
  const all = page.locator('#result .verdict .sentence, #result .shield, #details .facts');
  return all.evaluateAll((parts) => parts.map((part) => part.textContent));
}

/** A picture of both views. */
async function drawn(page: Page): Promise<Buffer> {
  await page.mouse.move(640, 5);
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      }),
  );
  return page.locator('#canvas').screenshot();
}

/** The largest difference of a colour (0 to 255) between two pictures. The browser may blend a button's shadow otherwise by 1. */
async function largestDifference(page: Page, one: Buffer, other: Buffer): Promise<number> {
  const [a, b] = await bothDecoded(page, one.toString('base64'), other.toString('base64'));
  return a.pixels.reduce((largest, value, k) => Math.max(largest, Math.abs(value - (b.pixels[k] ?? NaN))), 0);
}

/** The sentence of the status line about the place in the middle of the source. */
async function asked(page: Page): Promise<string> {
  const box = (await page.locator('#view-source').boundingBox()) ?? fail('there is no view');
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await expect(page.locator('#status')).toContainText('Here stretched up to');
  return page.locator('#status').innerText();
}

const EXPORTS = ['GLB', 'CSV', 'Base OBJ', 'Inverse table', 'Source shape', 'Target shape', 'Layout', 'Map file'];

/** All files that the page saves for a map. */
async function takenAway(page: Page): Promise<ReadonlyMap<string, Buffer>> {
  await openStep(page, 'use');
  const files = new Map<string, Buffer>();
  for (const name of EXPORTS) {
    files.set(name, (await downloaded(page, name)).content);
  }
  return files;
}

interface Known {
  readonly told: readonly string[];
  readonly asked: string;
  readonly drawn: Buffer;
  readonly files: ReadonlyMap<string, Buffer>;
}

async function known(page: Page): Promise<Known> {
  await openStep(page, 'map');
  await showSurface(page, 'Distortion');
  return { told: await told(page), drawn: await drawn(page), asked: await asked(page), files: await takenAway(page) };
}

/** A page that makes no map except that of the warm-up, which is the demo's. */
async function idlePage(context: BrowserContext): Promise<{ readonly page: Page; readonly runs: string[] }> {
  const page = await context.newPage();
  const runs: string[] = [];
  page.on('worker', (worker) => {
    if (worker.url().includes('/worker-')) {
      runs.push(worker.url());
    }
  });
  await open(page);
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
  return { page, runs };
}

test('a map comes back from its file as the run gave it, and what is wrong with one is said', { tag: '@long' }, async ({ page, context }) => {
  await openDemo(page, '#demo=sphere-tetrahedron');
  await page.locator('#run').click();
  await finished(page);
  const first = await known(page);
  await page.getByRole('button', { name: 'Share', exact: true }).click();
  const project = await downloaded(page, 'Save project file');
  await page.close();
  const entries = unzipSync(project.content);
  const entry = (pattern: RegExp): Saved => {
    const [name, bytes] = Object.entries(entries).find(([path]) => pattern.test(path)) ?? fail(`the project has no ${String(pattern)}`);
    return { name: name.slice(name.lastIndexOf('/') + 1), content: Buffer.from(bytes) };
  };
  const [source, target, map] = [entry(/^source\//), entry(/^target\//), entry(/\.conemap$/)];

  const { page: other, runs } = await idlePage(context);
  await dropContents(other, [map, target, source]);
  await expect(other.locator('#reopened')).toContainText('Opened from map.conemap: nothing was computed.', { timeout: 60_000 });
  await expect(other.locator('#view-source')).toContainText(source.name);
  await expect(other.locator('#view-target')).toContainText(target.name);
  await expect(other.locator('#status')).toHaveText('The map is done.');
  const again = await known(other);
  expect(again.told).toEqual(first.told);
  expect(again.asked).toBe(first.asked);
  expect(await largestDifference(other, first.drawn, again.drawn)).toBeLessThan(2);
  for (const [name, bytes] of first.files) {
    expect(again.files.get(name)?.equals(bytes), name).toBe(true);
  }

  // Undo leads to the state before the map, and redo to the map again.
  await openStep(other, 'map');
  await other.locator('#undo').click();
  await expect(other.locator('#result')).toHaveClass(/outdated/);
  await other.locator('#redo').click();
  await expect(other.locator('#result')).not.toHaveClass(/outdated/);

  // Neither a damaged map nor a map of other meshes removes anything from the page.
  const half = map.content.subarray(0, map.content.length / 2);
  const bent = Buffer.from(map.content);
  bent.fill(0xff, bent.length - 4000);
  const wrong = { name: 'wrong.obj', content: TETRAHEDRON };
  for (const [files, sentence] of [
    [[{ name: 'half.conemap', content: half }], /^half\.conemap: The map file/],
    [[{ name: 'bent.conemap', content: bent }], /^bent\.conemap: The map file/],
    [[map, source, wrong], /^map\.conemap: the target, wrong\.obj, is not the mesh that this map was made with/],
  ] as const) {
    await dropContents(other, files);
    await expect(other.locator('#error p')).toHaveText(sentence);
    await expect(other.locator('#view-target')).toContainText(target.name);
    await expect(other.locator('#result')).not.toHaveClass(/outdated/);
  }

  // A project brings its map, too; opened over the same map, it changes only the name that is shown.
  await dropContents(other, [project]);
  await expect(other.locator('#reopened')).toContainText(`Opened from ${project.name}`);
  await expect(other.locator('#result')).not.toHaveClass(/outdated/);
  expect(await told(other)).toEqual(first.told);
  expect(runs).toEqual([]);
  await other.close();

  // A map that is opened alone waits for its meshes, which are put on their sides.
  const { page: waiting } = await idlePage(context);
  await waiting.locator('#mesh-files').setInputFiles({ name: map.name, mimeType: '', buffer: map.content });
  const notice = waiting.locator('#map-notice');
  await expect(notice).toContainText(`map.conemap waits for its source (${source.name}) and its target (${target.name}): drop them here.`);
  await dropContents(waiting, [target]);
  await expect(notice).toContainText(`waits for its source (${source.name}): drop it here.`);
  await expect(waiting.locator('#view-target')).toContainText(target.name);
  await dropContents(waiting, [source]);
  await expect(waiting.locator('#reopened')).toBeVisible({ timeout: 60_000 });
  await expect(notice).toBeHidden();
  await openStep(waiting, 'landmarks');
  expect(await pairs(waiting).count()).toBeGreaterThan(3);
});
