/**
 * A restless user: random clicks, files, keys and interruptions, from a seed. Whatever happens, nothing breaks off, the page answers, and a
 * map of a demo can be made afterwards. CONEMAP_VISITS and CONEMAP_SEED choose the number of visits and the first seed.
 */
import type { Page } from '@playwright/test';
import { expect, test } from './test.ts';
import { CORNERS, rod } from '../unit/rod.ts';
import { Random } from '../unit/random.ts';
import { upload } from './own-files.ts';
import { dropContents, fail, finished, open } from './page.ts';

const VISITS = Number(process.env['CONEMAP_VISITS'] ?? 3);
const SEED = Number(process.env['CONEMAP_SEED'] ?? 1);
const STEPS = Number(process.env['CONEMAP_STEPS'] ?? 60);
/** The time after which an action without an answer counts as hanging the page, in ms. */
const ANSWER = 20_000;

const BALL = rod(1);
const FILES = [
  upload('ball.obj', BALL),
  upload('rod.obj', rod(3)),
  upload('corners.json', CORNERS),
  // The mesh is open, because its last lines are missing.
  upload('open.obj', BALL.split('\n').slice(0, -40).join('\n')),
  upload('cut-off.obj', BALL.slice(0, 9000)),
  upload('noise.ply', new Random(7).bytes(4000)),
  upload('wrong.json', '{"pairs": [[0, 100000]]}'),
  upload('empty.off', ''),
] as const;

/** A picture of one red pixel. */
const PICTURE = {
  name: 'red.png',
  mimeType: 'image/png',
  buffer: Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==', 'base64'),
};

const KEYS = ['Escape', 'Escape', 'Control+z', 'Control+z', 'Control+Shift+Z', 'Delete', 'Enter', 'ArrowLeft', 'ArrowDown', 'f', 'm', '?', 'Tab', 'Home', 'End', 'q', '0', '+'];

type Action = readonly [name: string, act: () => Promise<void>];

/** The next action of the user. */
function nextAction(page: Page, random: Random): Action {
  const file = random.of(FILES);
  const more = [random.of(FILES), random.of(FILES)];
  const side = random.of(['source', 'target']);
  const key = random.of(KEYS);
  const [x, y] = [random.unit(), random.unit()];
  const pick = random.below(1000);
  const kinds: readonly (readonly [number, Action])[] = [
    [6, [`choose ${file.name} for the ${side}`, () => page.locator(`#${side}-file`).setInputFiles(file)]],
    [2, ['lay a picture on the flat metric', () => page.locator('#texture-file').setInputFiles(pick % 3 === 0 ? file : PICTURE)]],
    [3, ['choose the landmarks', () => page.locator('#landmark-file').setInputFiles(FILES[2])]],
    [3, [`drop ${[file, ...more].map(({ name }) => name).join(', ')}`, () => dropContents(page, [file, ...more].map(({ name, buffer }) => ({ name, content: buffer })))]],
    [10, [`press ${key}`, () => page.keyboard.press(key)]],
    [8, [`click at ${x.toFixed(2)} ${y.toFixed(2)}`, () => clickCanvas(page, x, y)]],
    [4, [`drag from ${x.toFixed(2)} ${y.toFixed(2)}`, () => dragCanvas(page, x, y, random.unit(), random.unit())]],
    [8, ['run or cancel', () => press(page, '#run, #cancel', 0)]],
    [24, [`press button ${pick}`, () => press(page, 'button:not([disabled]), [role="tab"]', pick)]],
    [10, [`choose ${pick}`, () => press(page, 'input[type="radio"]:not([disabled]), input[type="checkbox"]:not([disabled])', pick)]],
    [3, [`slide ${pick}`, () => slide(page, pick)]],
    [1, ['reload', async () => { await page.reload(); await ready(page); }]],
    [1, [`follow a link to a demo`, () => page.evaluate(() => { location.hash = '#demo=sphere-tetrahedron'; })]],
    [1, ['turn the screen', () => page.setViewportSize(random.of([{ width: 1280, height: 800 }, { width: 400, height: 800 }, { width: 1900, height: 1000 }]))]],
  ];
  const whole = kinds.reduce((sum, [weight]) => sum + weight, 0);
  let at = random.unit() * whole;
  return (kinds.find(([weight]) => (at -= weight) < 0) ?? fail('no action'))[1];
}

async function ready(page: Page): Promise<void> {
  await expect(page.locator('body')).toHaveAttribute('data-ready', 'true', { timeout: 120_000 });
}

async function clickCanvas(page: Page, x: number, y: number): Promise<void> {
  const box = (await page.locator('#canvas').boundingBox()) ?? fail('no canvas');
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}

async function dragCanvas(page: Page, x: number, y: number, u: number, v: number): Promise<void> {
  const box = (await page.locator('#canvas').boundingBox()) ?? fail('no canvas');
  await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + u * box.width, box.y + v * box.height, { steps: 3 });
  await page.mouse.up();
}

/** Presses one of the visible elements by a script, so that it does not matter what lies over it. */
async function press(page: Page, selector: string, pick: number): Promise<void> {
  await page.evaluate(
    ([all, k]) => {
      const seen = [...document.querySelectorAll<HTMLElement>(all)].filter((element) => element.checkVisibility());
      seen[k % Math.max(seen.length, 1)]?.click();
    },
    [selector, pick] as const,
  );
}

async function slide(page: Page, pick: number): Promise<void> {
  await page.evaluate((k) => {
    const sliders = [...document.querySelectorAll<HTMLInputElement>('input[type="range"]:not([disabled])')].filter((element) => element.checkVisibility());
    const slider = sliders[k % Math.max(sliders.length, 1)];
    if (slider !== undefined) {
      const [low, high] = [Number(slider.min), Number(slider.max === '' ? 100 : slider.max)];
      slider.value = String(low + ((k % 97) / 96) * (high - low));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      slider.dispatchEvent(new Event('change', { bubbles: true }));
    }
  }, pick);
}

/** Fails where the work is not done within the time. */
async function answered(page: Page, work: Promise<unknown>, name: string): Promise<void> {
  const late = new Promise<never>((_, reject) => {
    setTimeout(() => {
      reject(new Error(`no answer to: ${name}`));
    }, ANSWER);
  });
  await Promise.race([work.then(() => page.evaluate(() => document.body.dataset['state'])), late]);
}

for (let visit = 0; visit < VISITS; visit += 1) {
  const seed = SEED + visit;
  test(`whatever a restless user does, nothing breaks: seed ${seed}`, { tag: '@long' }, async ({ page }) => {
    test.setTimeout(600_000);
    const done: string[] = [];
    const wrong: string[] = [];
    page.on('pageerror', (error) => {
      wrong.push(`${error.message} ${error.stack ?? ''} (after: ${done.slice(-3).join('; ')})`);
    });
    page.on('console', (message) => {
      if (message.type() === 'error') {
        wrong.push(`${message.text()} (after: ${done.slice(-3).join('; ')})`);
      }
    });
    page.on('dialog', (dialog) => {
      void dialog.accept();
    });
    const random = new Random(seed * 7919);
    await open(page, random.unit() < 0.5 ? '#demo=sphere-tetrahedron' : '');
    const sentences = new Set<string>();
    const states = new Map<string, number>();
    for (let step = 0; step < STEPS; step += 1) {
      const [name, act] = nextAction(page, random);
      done.push(name);
      await answered(page, act(), done.slice(-5).join('; '));
      const state = (await page.locator('body').getAttribute('data-state')) ?? '';
      states.set(state, (states.get(state) ?? 0) + 1);
      const error = page.locator('#error');
      if (await error.isVisible()) {
        sentences.add((await error.innerText()).split('\n')[0] ?? '');
      }
      if (random.unit() < 0.4) {
        await page.waitForTimeout(600 * random.unit());
      }
    }
    console.log(`seed ${seed}: steps by state ${JSON.stringify([...states])}; told: ${JSON.stringify([...sentences])}`);
    // Sentences are about files, never about the program.
    for (const sentence of sentences) {
      expect(sentence).not.toMatch(/unexpected|undefined|null|NaN|\[object|panicked/i);
    }
    expect(wrong, done.join('\n')).toEqual([]);
    // Afterwards a map can be made as on the first visit.
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.goto('about:blank');
    await open(page, '#demo=sphere-tetrahedron');
    const run = page.locator('#run');
    await expect(run, done.join('\n')).toBeEnabled({ timeout: 60_000 });
    // The page remembers that the panel was folded away.
    const panel = page.getByRole('button', { name: 'Show the panel' });
    if (await panel.isVisible()) {
      await panel.click();
    }
    await run.click();
    await finished(page);
    await expect(page.locator('#result')).toContainText('Certified bijective');
    expect(wrong, done.join('\n')).toEqual([]);
  });
}
