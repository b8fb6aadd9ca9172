/** Actions that many tests of the page need. */
import { existsSync, readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Locator, Page } from '@playwright/test';
import { expect, test } from './test.ts';

export const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const SHARED = `${ROOT}../shared`;
export const DATA = `${SHARED}/data`;
export const RUN_TIMEOUT = 200_000;

/** Skips a test where there is no folder `../shared`. Where there is one, a file that it lacks fails the test that reads the file. */
export function needsSharedData(): void {
  test.skip(
    !existsSync(SHARED),
    'the real meshes (../shared/data) are not part of a plain checkout',
  );
}

export function fail(message: string): never {
  throw new Error(message);
}

/** The smallest closed mesh, as OBJ: the corner of a box with three lengths of edges. */
export const TETRAHEDRON = 'v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n';

/** Waits for an attribute of the body. It is read often: the usual intervals grow to a second, which many tests would have to wait. */
async function expectSaid(page: Page, attribute: string, words: RegExp, timeout: number): Promise<void> {
  await expect.poll(async () => (await page.locator('body').getAttribute(attribute)) ?? '', { intervals: [50], timeout }).toMatch(words);
}

/** Opens the page and waits until it can be used. */
export async function open(page: Page, hash = ''): Promise<void> {
  await page.goto(`/${hash}`);
  await expectSaid(page, 'data-ready', /^true$/, 120_000);
}

/** A demo whose run goes on for longer than a picture takes, makes several previews, and tells several energies also where the machine is busy. */
export const LONG_RUN = '#demo=wolf-cow';

/** Opens the page with a demo, ready to be mapped. */
export async function openDemo(page: Page, hash = '#demo=horse-cat'): Promise<void> {
  await open(page, hash);
  await expect(page.locator('#run')).toBeEnabled({ timeout: 60_000 });
}

/** Opens a step's panel, unless it is open already. */
export async function openStep(page: Page, step: 'meshes' | 'landmarks' | 'map' | 'use' | 'method'): Promise<void> {
  const button = page.locator(`#step-${step}`);
  const isOpen = (await button.getAttribute('aria-current')) === 'step' && (await page.locator('#panel .content').isVisible());
  if (!isOpen) {
    await button.click();
  }
  await expect(page.locator('#panel .content')).toBeVisible();
}

/** The rows of the pairs that have both points. */
export function pairs(page: Page): Locator {
  return page.locator('#landmark-list [data-pair]');
}

/** Drops files on the page like a user. */
export async function drop(page: Page, paths: readonly string[]): Promise<void> {
  await dropContents(
    page,
    paths.map((path) => ({ name: basename(path), content: readFileSync(path) })),
  );
}

/** Drops files that are not on a disk. */
export async function dropContents(page: Page, given: readonly { readonly name: string; readonly content: Buffer | string }[]): Promise<void> {
  const files = given.map(({ name, content }) => ({ name, base64: Buffer.from(content).toString('base64') }));
  const transfer = await page.evaluateHandle((list) => {
    const data = new DataTransfer();
    for (const { name, base64 } of list) {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      data.items.add(new File([bytes], name));
    }
    return data;
  }, files);
  await page.dispatchEvent('body', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

/** Waits for the end of a run, which must have succeeded. */
export async function finished(page: Page): Promise<void> {
  await expectSaid(page, 'data-state', /done|error/, RUN_TIMEOUT);
  await expect(page.locator('#error')).toBeHidden();
}

/** Makes the map and waits for its certificate. */
export async function runMap(page: Page): Promise<void> {
  await page.locator('#run').click();
  await finished(page);
  await expect(page.locator('#result')).toContainText(/Certified bijective: 0 of [\d,]+ triangles flipped/);
}

/** Chooses what the surfaces show, in the menu on the view. */
export async function showSurface(page: Page, name: string): Promise<void> {
  await page.getByRole('button', { name: /^Picture: / }).click();
  await page.getByRole('radio', { name, exact: true }).check();
  await page.keyboard.press('Escape');
}

/** Waits until the browser has kept work with this many pairs. */
export async function kept(page: Page, pairs: number): Promise<void> {
  const counts = (): Promise<number[]> =>
    page.evaluate(
      () =>
        new Promise<number[]>((resolve, reject) => {
          const opening = indexedDB.open('conemap');
          opening.onerror = () => {
            reject(new Error('the store does not open'));
          };
          opening.onsuccess = () => {
            const database = opening.result;
            const all = database.transaction('sessions').objectStore('sessions').getAll();
            all.onsuccess = () => {
              database.close();
              resolve((all.result as { work: { pairs: unknown[] } }[]).map(({ work }) => work.pairs.length));
            };
          };
        }),
    );
  await expect.poll(counts).toContain(pairs);
}
