/** The canvas on the screen: its size in pixels, the boxes of both views in it, and changes of these. */
import { SIDES } from '../landmarks.ts';
import type { Viewer } from '../wasm/page.js';

/** The samples per pixel: four, or one where a processor draws instead of a graphics card. */
export function samplesOf(): number {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) {
    return 4;
  }
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = gl.getParameter(info === null ? gl.RENDERER : info.UNMASKED_RENDERER_WEBGL);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name)) ? 1 : 4;
}

/** The largest side of a canvas, in pixels, on which all browsers with WebGL 2 can draw. */
const LARGEST_SIDE = 8192;

/**
 * Gives a canvas `times` as many pixels on each side as the screen shows, or as many as can be drawn; returns the number of pixels per CSS
 * pixel.
 */
export function fitCanvas(canvas: HTMLCanvasElement, times = 1): number {
  const side = Math.max(1, canvas.clientWidth, canvas.clientHeight) * window.devicePixelRatio;
  const ratio = window.devicePixelRatio * Math.min(times, Math.max(1, LARGEST_SIDE / side));
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  return ratio;
}

/** Gives a renderer the size of its canvas, `times` that of the screen, and the boxes of both views in it. */
export function fitViewer(
  viewer: Viewer,
  canvas: HTMLCanvasElement,
  elements: readonly [HTMLElement, HTMLElement],
  times = 1,
): void {
  const ratio = fitCanvas(canvas, times);
  const { width, height } = canvas;
  viewer.resize(width, height, ratio);
  const frame = canvas.getBoundingClientRect();
  for (const side of SIDES) {
    const box = elements[side].getBoundingClientRect();
    const left = Math.max(0, Math.round((box.left - frame.left) * ratio));
    const top = Math.max(0, Math.round((box.top - frame.top) * ratio));
    const right = Math.min(width, Math.round((box.left - frame.left + box.width) * ratio));
    const bottom = Math.min(height, Math.round((box.top - frame.top + box.height) * ratio));
    viewer.setViewport(side, left, top, Math.max(1, right - left), Math.max(1, bottom - top));
  }
}

/** Calls back when an element changes its size, or the screen its resolution. */
export function whenResized(elements: readonly HTMLElement[], callback: () => void): void {
  const observer = new ResizeObserver(callback);
  elements.forEach((element) => {
    observer.observe(element);
  });
  const watchRatio = (): void => {
    window.matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`).addEventListener(
      'change',
      () => {
        callback();
        watchRatio();
      },
      { once: true },
    );
  };
  watchRatio();
}
