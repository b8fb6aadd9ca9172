/**
 * Visits the built page in every browser that is installed: the first demo is seen, own files are dropped and mapped, steps are undone, a
 * run is cancelled, and a reload loses nothing. Browsers that are not installed are reported as skipped.
 */
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { ownFiles } from '../web/own-files.ts';
import { CHROMIUM, FIREFOX, FIREFOX_WITHOUT_WEBGL } from './bidi.ts';
import type { Browser, Launcher } from './browser.ts';
import { until } from './browser.ts';
import type { Host } from './host.ts';
import { serve } from './host.ts';
import { WEBKIT } from './webkit.ts';

/** The longest times of loading and of mapping, in seconds. */
const LOADING = 120;
const MAPPING = 240;

const STATE = 'return document.body.dataset.state;';
const PAIRS = 'return Number(document.body.dataset.pairs);';
const NAMES = `return ['source', 'target'].map((side) => document.getElementById('view-' + side).textContent).join(' ');`;
const ERROR = `const error = document.getElementById('error'); return error !== null && !error.hidden ? error.textContent : '';`;

/** The number of colours that each half of the canvas shows beside that of its corner, right after a frame that a small turn has caused. */
const COLOURS = `return new Promise((resolve) => {
  const turn = (id) => document.querySelector(id).dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true }));
  turn('#view-source');
  turn('#view-target');
  requestAnimationFrame(() => {
    const canvas = document.querySelector('#canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const half = Math.floor(canvas.width / 2);
    resolve([0, half].map((left) => {
      const { data } = context.getImageData(left + 2, 2, half - 4, canvas.height - 4);
      return new Set(new Uint32Array(data.buffer)).size;
    }));
  });
});`;

let host: Host;
beforeAll(async () => {
  host = await serve();
});
afterAll(async () => {
  await host.close();
});

/** Drops files like a user. */
async function drop(browser: Browser, files: readonly { readonly name: string; readonly buffer: Buffer }[]): Promise<void> {
  const given = files.map(({ name, buffer }) => ({ name, base64: buffer.toString('base64') }));
  await browser.evaluate(`
    const data = new DataTransfer();
    for (const { name, base64 } of ${JSON.stringify(given)}) {
      data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    }
    for (const kind of ['dragover', 'drop']) {
      document.body.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
    }`);
}

async function isIdle(browser: Browser): Promise<void> {
  await until(browser, STATE, (state) => state === 'idle', LOADING);
  expect(await browser.evaluate(ERROR)).toBe('');
}

/** Maps the user's own horse and cat, from files that are dropped. */
async function mapOwn(browser: Browser): Promise<void> {
  const { horse, cat, landmarks, pairs } = ownFiles();
  await drop(browser, [horse, cat, landmarks]);
  await until(browser, NAMES, (names) => /horse\.obj.*cat\.obj/s.test(String(names)), LOADING);
  await isIdle(browser);
  expect(await browser.evaluate(PAIRS)).toBe(pairs);
  await browser.click('#run');
  await until(browser, STATE, (state) => state === 'done' || state === 'error', MAPPING);
  expect(await browser.evaluate(ERROR)).toBe('');
  expect(await browser.evaluate(`return document.getElementById('result').textContent;`)).toMatch(
    /Certified bijective: 0 of [\d,.]+ triangles flipped/,
  );
}

function visit(launcher: Launcher): void {
  const { name, program } = launcher;
  describe.skipIf(program === null)(name, () => {
    let browser: Browser;
    beforeAll(async () => {
      browser = await launcher.begin(program ?? '');
    });
    afterAll(async () => {
      await browser.close();
    });

    test('the first demo is seen', async () => {
      await browser.open(host.url);
      await until(browser, 'return document.body.dataset.ready;', (ready) => ready === 'true', LOADING);
      await until(browser, PAIRS, (pairs) => Number(pairs) > 20, LOADING);
      await isIdle(browser);
      await until(browser, COLOURS, (colours) => (colours as number[]).every((count) => count > 200), LOADING);
    });

    test('own files are mapped, taken back and brought again with their map', async () => {
      await browser.open(`${host.url}#demo=horse-cat`);
      await until(browser, 'return document.body.dataset.demo;', (demo) => demo === 'horse-cat', LOADING);
      await isIdle(browser);
      const plain = (await browser.evaluate(COLOURS)) as number[];
      await mapOwn(browser);
      await until(browser, COLOURS, (colours) => (colours as number[]).every((count, k) => count > 1.2 * (plain[k] ?? 0)), 10);
      await browser.pressWithControl('z');
      await until(browser, NAMES, (names) => !String(names).includes('horse.obj'), 10);
      await browser.pressWithControl('y');
      await until(browser, NAMES, (names) => /horse\.obj.*cat\.obj/s.test(String(names)), 10);
      await until(browser, STATE, (state) => state === 'done', 10);
    });

    test('a run is cancelled, and a reload loses nothing', async () => {
      await browser.open(`${host.url}#demo=poses`);
      await until(browser, 'return document.body.dataset.demo;', (demo) => demo === 'poses', LOADING);
      await isIdle(browser);
      await browser.click('#run');
      await until(browser, STATE, (state) => state === 'running', 10);
      await browser.click('#cancel');
      await isIdle(browser);
      const { horse } = ownFiles();
      await drop(browser, [horse]);
      await until(browser, NAMES, (names) => String(names).includes('horse.obj'), LOADING);
      await isIdle(browser);
      // The page writes changes of the work only after a moment.
      await new Promise((resolve) => setTimeout(resolve, 1500));
      await browser.reload();
      await until(browser, NAMES, (names) => String(names).includes('horse.obj'), LOADING);
      await isIdle(browser);
    });
  });
}

visit(CHROMIUM);
visit(FIREFOX);
visit(WEBKIT);

const { name, program } = FIREFOX_WITHOUT_WEBGL;
describe.skipIf(program === null)(name, () => {
  test('the page says that it cannot draw, and maps all the same', async () => {
    const browser = await FIREFOX_WITHOUT_WEBGL.begin(program ?? '');
    try {
      await browser.open(`${host.url}#demo=horse-cat`);
      await until(browser, 'return document.body.dataset.demo;', (demo) => demo === 'horse-cat', LOADING);
      await isIdle(browser);
      await mapOwn(browser);
      expect(await browser.evaluate(`return document.getElementById('undrawn').textContent;`)).toContain('WebGL 2');
    } finally {
      await browser.close();
    }
  });
});
