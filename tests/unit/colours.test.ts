/** A colour that is used by style sheets, canvases, files and the views has the same value in all of them. */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import * as colours from '../../www/colours.ts';

const text = (path: string): string => readFileSync(fileURLToPath(new URL(`../../${path}`, import.meta.url)), 'utf8');

test('the colours of drawings are those of the theme', () => {
  const theme = text('www/styles/theme.css');
  const of = (name: string): string[] => [...(new RegExp(`--${name}: light-dark\\((#\\w+), (#\\w+)\\);`).exec(theme)?.slice(1) ?? [])];
  for (const name of ['INK', 'QUIET', 'LINE', 'ACCENT', 'DOUBT', 'POSITIVE', 'NEGATIVE', 'CUT'] as const) {
    const { light, dark } = colours[name];
    expect(of(name.toLowerCase()), name).toEqual([light, dark]);
  }
  expect(of('canvas')[1]).toBe(colours.GROUND.dark);
});

test('no other code of the page has a colour of its own', () => {
  const files = readdirSync(fileURLToPath(new URL('../../www', import.meta.url)), { recursive: true, encoding: 'utf8' });
  const code = files.filter((file) => /\.tsx?$/.test(file) && !file.startsWith('wasm') && file !== 'colours.ts');
  expect(code).toContain('main.ts');
  const own = code.flatMap((file) => [...text(`www/${file}`).matchAll(/["'`]#(?:[\da-f]{3}|[\da-f]{6})["'`]/gi)].map(([colour]) => `${file}: ${colour}`));
  const sheets = files.filter((file) => file.endsWith('.css') && !file.endsWith('theme.css'));
  expect(sheets.length).toBeGreaterThan(10);
  const inSheets = sheets.flatMap((file) => [...text(`www/${file}`).matchAll(/#[\da-f]{3,8}\b|\b(?:rgb|hsl)\(/gi)].map(([colour]) => `${file}: ${colour}`));
  expect([...own, ...inSheets]).toEqual([]);
});

test('the views mark cuts and what is lit up in the colours of the drawings', () => {
  const constant = (file: string, name: string): string =>
    `#${new RegExp(`const ${name}: u32 = 0x(\\w+);`).exec(text(`src/scene/${file}.rs`))?.[1]?.replaceAll('_', '') ?? ''}`;
  expect(constant('seams', 'BOUNDARY')).toBe(colours.CUT.light);
  expect(constant('patches', 'LIT')).toBe(colours.LIT.light);
});
