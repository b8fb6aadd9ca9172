/** The page's files import each other without circles, and its parts in the order that docs/page.md lists. */
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { expect, test } from 'vitest';

const WWW = fileURLToPath(new URL('../../www', import.meta.url));

type Graph = ReadonlyMap<string, ReadonlySet<string>>;

/** The imports of every file of the page, except the built modules; imports of types count. */
function imports(): Graph {
  const files = readdirSync(WWW, { recursive: true, encoding: 'utf8' }).filter(
    (file) => /\.tsx?$/.test(file) && !file.startsWith('wasm'),
  );
  return new Map(
    files.map((file) => {
      const { importedFiles } = ts.preProcessFile(readFileSync(join(WWW, file), 'utf8'));
      const paths = importedFiles.map(({ fileName }) => fileName).filter((path) => path.startsWith('.'));
      return [file, new Set(paths.map((path) => relative(WWW, join(WWW, dirname(file), path))))];
    }),
  );
}

/** The parts of the page, folders and single files, each with its line in the list of docs/page.md. */
function parts(): ReadonlyMap<string, number> {
  const text = readFileSync(join(WWW, '../docs/page.md'), 'utf8');
  const list = /(?<=each only with what stands above it:\n\n)(?:- .*\n)+/.exec(text)?.[0] ?? '';
  const names = (line: string): string[] => [...(line.split(': ')[0] ?? '').matchAll(/`([\w-]+)/g)].map(([, name]) => name ?? '');
  return new Map(list.split('\n').flatMap((line, rank) => names(line).map((name) => [name, rank] as const)));
}

/** A path through the graph that returns to its beginning; `null` where there is none. */
function circle(graph: Graph): string[] | null {
  const done = new Set<string>();
  const visit = (node: string, path: readonly string[]): string[] | null => {
    if (path.includes(node)) {
      return [...path.slice(path.indexOf(node)), node];
    }
    if (done.has(node)) {
      return null;
    }
    for (const next of graph.get(node) ?? []) {
      const found = visit(next, [...path, node]);
      if (found !== null) {
        return found;
      }
    }
    done.add(node);
    return null;
  };
  for (const node of graph.keys()) {
    const found = visit(node, []);
    if (found !== null) {
      return found;
    }
  }
  return null;
}

test('a circle is found where there is one', () => {
  const graph = (edges: Record<string, string[]>): Graph =>
    new Map(Object.entries(edges).map(([from, to]) => [from, new Set(to)]));
  expect(circle(graph({ a: ['b', 'c'], b: ['d'], c: ['d'], d: [] }))).toBeNull();
  expect(circle(graph({ a: ['b'], b: ['c', 'd'], c: [], d: ['b'] }))).toEqual(['b', 'd', 'b']);
  expect(circle(graph({ a: ['a'] }))).toEqual(['a', 'a']);
});

test('files import each other in one direction', () => {
  const graph = imports();
  // Every imported file exists, so no path was misread.
  const missing = [...graph.values()].flatMap((targets) =>
    [...targets].filter((target) => !target.startsWith('wasm') && !target.endsWith('.css') && !graph.has(target)),
  );
  expect(missing).toEqual([]);
  expect(graph.get('main.ts')).toContain(join('store', 'store.ts'));
  expect(circle(graph)).toBeNull();
});

/** All files that a file loads when it runs, itself included: all imports except types. */
function reached(file: string, seen = new Set<string>()): ReadonlySet<string> {
  if (!seen.has(file)) {
    seen.add(file);
    const text = file.startsWith('wasm') || file.endsWith('.css') ? '' : readFileSync(join(WWW, file), 'utf8');
    for (const [, path] of text.matchAll(/^(?:import|export) (?!type )(?:[^;]*? from )?'(\.[^']+)'/gm)) {
      reached(relative(WWW, join(WWW, dirname(file), path ?? '')), seen);
    }
  }
  return seen;
}

test('workers of meshes and maps run by the core alone, the page and its worker of files without it', () => {
  const [core, page] = [join('wasm', 'core.js'), join('wasm', 'page.js')];
  const files = [...imports().keys()];
  const workers = files.filter((file) => reached(file).has(core));
  expect(workers).toEqual(expect.arrayContaining([join('compute', 'worker.ts'), join('method', 'plane-worker.ts'), join('reading', 'mesh-worker.ts')]));
  expect(workers.filter((file) => reached(file).has(page))).toEqual([]);
  expect(workers.filter((file) => !/worker\.ts$|warmer\.ts$|mesh-answers\.ts$/.test(file))).toEqual([]);
  expect(reached(join('reading', 'file-worker.ts'))).toContain(page);
  expect(reached('main.ts')).toContain(page);
});

test('each part imports only what stands above it in docs/page.md', () => {
  const ranks = parts();
  const partOf = (file: string): string => (file.split(sep)[0] ?? '').replace(/\.ts$/, '');
  const wrong: string[] = [];
  for (const [file, targets] of imports()) {
    const rank = ranks.get(partOf(file));
    if (rank === undefined) {
      wrong.push(`${file} is in no part`);
      continue;
    }
    for (const target of targets) {
      const above = ranks.get(partOf(target)) ?? -1;
      if (partOf(file) !== partOf(target) && !target.startsWith('wasm') && above >= rank) {
        wrong.push(`${file} imports ${target}`);
      }
    }
  }
  expect(wrong).toEqual([]);
});
