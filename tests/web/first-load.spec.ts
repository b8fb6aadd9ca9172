/** What the browser fetches before a mesh can be dropped: no equations and no plots, which come when they are asked for. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { expect, test } from '@playwright/test';
import { ROOT } from './page.ts';

const ASSETS = join(ROOT, 'dist/assets');
/** In bytes, packed with gzip. */
const LARGEST_FIRST_LOAD = 150_000;

/** The scripts that index.html asks for, with all that they import at once. */
function firstScripts(): ReadonlyMap<string, string> {
  const found = new Map<string, string>();
  const visit = (name: string): void => {
    if (!found.has(name)) {
      const code = readFileSync(join(ASSETS, name), 'utf8');
      found.set(name, code);
      for (const [, imported] of code.matchAll(/(?:from|import)\s*"\.\/([\w.-]+\.js)"/g)) {
        visit(imported ?? '');
      }
    }
  };
  const html = readFileSync(join(ROOT, 'dist/index.html'), 'utf8');
  for (const [, name] of html.matchAll(/(?:src|href)="\.\/assets\/([\w.-]+\.js)"/g)) {
    visit(name ?? '');
  }
  return found;
}

test('the first load has no part of KaTeX and uPlot, and stays small', () => {
  const first = firstScripts();
  expect(first.size).toBeGreaterThan(0);
  const all = readdirSync(ASSETS).filter((name) => name.endsWith('.js'));
  for (const sign of [/katex/i, /u-hz/]) {
    const holding = all.filter((name) => sign.test(readFileSync(join(ASSETS, name), 'utf8')));
    expect(holding.length, `${sign.source} is in the build`).toBeGreaterThan(0);
    expect(holding.filter((name) => first.has(name)), `${sign.source} is not in the first load`).toEqual([]);
  }
  const size = [...first.values()].reduce((sum, code) => sum + gzipSync(code).length, 0);
  expect(size).toBeLessThan(LARGEST_FIRST_LOAD);
});
