/** Reads what the views show: pins by their numbers, pixels, and how often something is drawn. */
import type { Page } from '@playwright/test';
import { fail } from './page.ts';

export interface Spot {
  readonly x: number;
  readonly y: number;
}

/** The draw calls since the last question. */
export interface Drawn {
  readonly calls: number;
  /** The number of triangles of the largest call. */
  readonly triangles: number;
  /** When each call was made, by the page's clock, in ms. */
  readonly at: readonly number[];
}

/** A coarse map that the page has received. */
export interface Preview {
  /** The time by the page's clock, in ms. */
  readonly at: number;
  readonly places: Float32Array;
}

/** The distance from the middle of a pin's head to its number, also for a raised number, and down to the pin's place, in CSS pixels. */
const NUMBER_BESIDE = 8;
const RAISED_BESIDE = 10;
export const STEM = 17;

/** A time longer than a camera's glide and rest, in ms. */
export const SETTLED = 900;

/** Counts the draw calls of a page from its first frame on; must be called before the page is opened. */
export async function countDraws(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const drawn = { calls: 0, triangles: 0, at: [] as number[] };
    Reflect.set(window, 'drawn', drawn);
    const { prototype } = WebGL2RenderingContext;
    for (const name of ['drawElements', 'drawElementsInstanced', 'drawArrays', 'drawArraysInstanced'] as const) {
      const draw: (...rest: number[]) => void = Reflect.get(prototype, name);
      Reflect.set(prototype, name, function (this: WebGL2RenderingContext, ...rest: number[]) {
        drawn.calls += 1;
        drawn.at.push(performance.now());
        if (name.startsWith('drawElements')) {
          drawn.triangles = Math.max(drawn.triangles, (rest[1] ?? 0) / 3);
        }
        draw.apply(this, rest);
      });
    }
  });
}

/** The draw calls since the last question. */
export async function drawn(page: Page): Promise<Drawn> {
  return page.evaluate(() => {
    const counts = Reflect.get(window, 'drawn') as { calls: number; triangles: number; at: number[] };
    const copy = { ...counts };
    counts.calls = 0;
    counts.triangles = 0;
    counts.at = [];
    return copy;
  });
}

/** Keeps each coarse map that the page receives in `window.previews`; must be called before the page is opened. */
export async function keepPreviews(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const told: Preview[] = [];
    Reflect.set(window, 'previews', told);
    const { prototype } = Worker;
    const add: (...rest: unknown[]) => void = Reflect.get(prototype, 'addEventListener') as never;
    Reflect.set(prototype, 'addEventListener', function (this: Worker, kind: string, ...rest: unknown[]) {
      if (kind === 'message') {
        add.call(this, kind, (event: MessageEvent<{ kind?: string; places?: Float32Array }>) => {
          if (event.data.kind === 'preview' && event.data.places !== undefined) {
            told.push({ at: performance.now(), places: event.data.places });
          }
        });
      }
      add.call(this, kind, ...rest);
    });
  });
}

/** The times at which the coarse maps were received, by the page's clock, in ms. */
export async function previewTimes(page: Page): Promise<number[]> {
  return page.evaluate(() => (Reflect.get(window, 'previews') as Preview[]).map(({ at }) => at));
}

/** The middles of the visible pins' heads in the window, by the pins' numbers. */
export async function heads(page: Page, view: string): Promise<Map<string, Spot>> {
  const list = await page.locator(`${view} .labels span`).evaluateAll((spans) =>
    spans
      .filter((span) => !(span as HTMLElement).hidden)
      .map((span) => {
        const box = span.getBoundingClientRect();
        const spot = { x: box.left, y: box.top + box.height / 2 };
        return { number: span.textContent, spot, raised: span.classList.contains('raised') };
      }),
  );
  return new Map(list.map(({ number, spot, raised }) => [number, { x: spot.x - (raised ? RAISED_BESIDE : NUMBER_BESIDE), y: spot.y }]));
}

export function distance(a: Spot, b: Spot): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** The distances by which the pins that are visible before and after have moved. */
export function moves(before: ReadonlyMap<string, Spot>, after: ReadonlyMap<string, Spot>): number[] {
  return [...before].flatMap(([number, spot]) => {
    const now = after.get(number);
    return now === undefined ? [] : [distance(spot, now)];
  });
}

/** A PNG with a left and a right half of different colours. */
export async function halvesPicture(page: Page, colours: readonly [string, string], size: readonly [number, number]): Promise<Buffer> {
  const url = await page.evaluate(
    ([[left, right], [width, height]]) => {
      const canvas = Object.assign(document.createElement('canvas'), { width, height });
      const context = canvas.getContext('2d');
      for (const [colour, x] of [[left, 0], [right, width / 2]] as const) {
        if (context !== null) {
          context.fillStyle = colour;
          context.fillRect(x, 0, width / 2, height);
        }
      }
      return canvas.toDataURL('image/png');
    },
    [colours, size] as const,
  );
  return Buffer.from(url.slice(url.indexOf(',') + 1), 'base64');
}

/** A picture: four bytes a pixel (red, green, blue, opacity), row by row. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  readonly pixels: Uint8Array;
}

/** The picture in a PNG file (base64), as the browser decodes it. */
export async function decoded(page: Page, file: string): Promise<Picture> {
  const { width, height, read } = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context?.drawImage(image, 0, 0);
    const pixels = context?.getImageData(0, 0, image.width, image.height).data ?? new Uint8ClampedArray();
    // This is by far the quickest way to get a text.
    const text = await new Promise<string>((resolve) => {
      const reader = new FileReader();
      reader.onload = () => {
        resolve(typeof reader.result === 'string' ? reader.result : '');
      };
      reader.readAsDataURL(new Blob([pixels]));
    });
    return { width: image.width, height: image.height, read: text };
  }, file);
  const pixels = Buffer.from(read.slice(read.indexOf(',') + 1), 'base64');
  return pixels.length === 4 * width * height ? { width, height, pixels } : fail('the picture was not decoded');
}

/** Two pictures of one size. */
export async function bothDecoded(page: Page, one: string, other: string): Promise<readonly [Picture, Picture]> {
  const [a, b] = [await decoded(page, one), await decoded(page, other)];
  return a.width === b.width && a.height === b.height ? [a, b] : fail('two pictures of one size are needed');
}

async function pictureOf(page: Page, element: string): Promise<Picture> {
  const clip = (await page.locator(element).boundingBox()) ?? fail(`${element} has no box`);
  return decoded(page, (await page.screenshot({ clip })).toString('base64'));
}

/** The pixels of the visible part of an element, four bytes each: red, green, blue, opacity. */
export async function pixelsOf(page: Page, element: string): Promise<Uint8Array> {
  return (await pictureOf(page, element)).pixels;
}

/** The least distance of a place from the outline of the body, and from the next place, in pixels. */
const INSIDE = 12;
const APART = 40;

/** Places well inside the body in a view, apart from each other, from the view's middle outwards. */
export async function placesOnBody(page: Page, view: string): Promise<Spot[]> {
  const box = (await page.locator(view).boundingBox()) ?? fail(`${view} has no box`);
  const { width, height, pixels } = await pictureOf(page, view);
  const colour = (x: number, y: number): string => pixels.subarray(4 * (y * width + x), 4 * (y * width + x + 1)).join();
  const ground = colour(2, 2);
  const around = [-INSIDE, 0, INSIDE].flatMap((dx) => [-INSIDE, 0, INSIDE].map((dy) => [dx, dy] as const));
  const found: Spot[] = [];
  for (let y = INSIDE; y < height - INSIDE; y += INSIDE) {
    for (let x = INSIDE; x < width - INSIDE; x += INSIDE) {
      if (around.every(([dx, dy]) => colour(x + dx, y + dy) !== ground)) {
        found.push({ x, y });
      }
    }
  }
  const middle = { x: width / 2, y: height / 2 };
  const apart: Spot[] = [];
  for (const spot of found.sort((a, b) => distance(a, middle) - distance(b, middle))) {
    if (apart.every((other) => distance(spot, other) > APART)) {
      apart.push(spot);
    }
  }
  return apart.map(({ x, y }) => ({ x: box.x + x, y: box.y + y }));
}

/** The number of pixels for which `isSo` is true. */
export function countPixels(pixels: Uint8Array, isSo: (red: number, green: number, blue: number) => boolean): number {
  let count = 0;
  for (let at = 0; at < pixels.length; at += 4) {
    count += isSo(pixels[at] ?? 0, pixels[at + 1] ?? 0, pixels[at + 2] ?? 0) ? 1 : 0;
  }
  return count;
}

/** The shares of a view's pixels that are red, blue and green. */
export async function seen(page: Page, view: 'source' | 'target'): Promise<{ red: number; blue: number; green: number }> {
  const pixels = await pixelsOf(page, `#view-${view}`);
  const share = (isSo: (red: number, green: number, blue: number) => boolean): number => countPixels(pixels, isSo) / (pixels.length / 4);
  return {
    red: share((r, g, b) => r > 2 * Math.max(g, b) + 30),
    blue: share((r, g, b) => b > 2 * Math.max(r, g) + 30),
    green: share((r, g, b) => g > 2 * Math.max(r, b) + 30),
  };
}
