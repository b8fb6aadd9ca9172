/** What the page relies on in the built modules. */
import { beforeAll, expect, test } from 'vitest';
import type { Demo } from '../../www/store/state.ts';
import { buildDemo, demoList, landmarkColour } from '../../www/wasm/page.js';
import { startPageModule } from './modules.ts';

beforeAll(() => {
  startPageModule();
});

test('the demo with the smallest meshes, whose map warms the core, is the last one', () => {
  const sizes = (JSON.parse(demoList()) as Demo[]).map(({ id }) => {
    const files = buildDemo(id);
    expect(files, id).toBeDefined();
    return (files?.source().length ?? 0) + (files?.target().length ?? 0);
  });
  expect(sizes.length).toBeGreaterThanOrEqual(10);
  expect(Math.min(...sizes)).toBe(sizes.at(-1));
});

test('the colours of many landmarks are colours, and differ', () => {
  const colours = Array.from({ length: 33 }, (_, index) => [...landmarkColour(index)]);
  for (const colour of colours) {
    expect(colour).toHaveLength(3);
    expect(Math.min(...colour)).toBeGreaterThanOrEqual(0);
    expect(Math.max(...colour)).toBeLessThanOrEqual(1);
  }
  expect(new Set(colours.map(String)).size).toBe(33);
});
