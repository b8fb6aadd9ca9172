/** The files that are kept for visits without a network, and what the page may load and connect to. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import { precacheOf } from '../../www/offline/build.ts';
import type { Precache } from '../../www/offline/precache.ts';
import { cacheName, keptPath, outdated } from '../../www/offline/precache.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const SCOPE = 'https://a.b/tools/conemap/';

const PRECACHE: Precache = {
  version: 'v2',
  files: ['', 'icon.svg', 'assets/index-1.js'].map((path) => ({ path, integrity: 'sha256-x' })),
};

function asked(path: string, mode: RequestMode = 'cors', method = 'GET'): string | null {
  return keptPath({ url: new URL(path, SCOPE).href, mode, method }, SCOPE, PRECACHE);
}

describe('a request', () => {
  test('for the page is answered from the cache, by folder or name, whatever it is asked', () => {
    for (const path of ['', 'index.html', '?utm=1', 'index.html?a=b', '#demo=cat']) {
      expect(asked(path, 'navigate'), path).toBe('');
    }
  });

  test('for a part of it too, and for parts of earlier builds', () => {
    expect(asked('icon.svg')).toBe('icon.svg');
    expect(asked('assets/index-1.js')).toBe('assets/index-1.js');
    expect(asked('assets/index-0.js')).toBe('assets/index-0.js');
  });

  test('for anything else is left to the network', () => {
    for (const path of ['other.html', 'icon.svg?x', 'https://c.d/tools/conemap/icon.svg', '../icon.svg', '']) {
      expect(asked(path), path).toBeNull();
    }
    expect(asked('docs/', 'navigate')).toBeNull();
    expect(asked('icon.svg', 'cors', 'POST')).toBeNull();
  });
});

test('caches of builds before the last are given up, and those of other pages left', () => {
  const name = (version: string): string => cacheName(SCOPE, version);
  const names = [name('v0'), 'other', name('v1'), cacheName('https://a.b/tools/', 'v0'), name('v2')];
  expect(outdated(names, SCOPE, 'v2')).toEqual([name('v0')]);
  expect(outdated([name('v2')], SCOPE, 'v2')).toEqual([]);
});

test('the list of a built page holds every file with its hash, and changes with each', () => {
  const folder = mkdtempSync(join(tmpdir(), 'conemap-'));
  try {
    mkdirSync(join(folder, 'assets'));
    writeFileSync(join(folder, 'index.html'), '<!doctype html>');
    writeFileSync(join(folder, 'assets', 'a.js'), 'abc');
    const first = precacheOf(folder);
    expect(first.files).toEqual([
      { path: 'assets/a.js', integrity: 'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=' },
      { path: '', integrity: expect.stringMatching(/^sha256-[\w+/]{43}=$/) as string },
    ]);
    writeFileSync(join(folder, 'service-worker.js'), 'not part of its own list');
    writeFileSync(join(folder, '_headers'), 'for the host alone');
    expect(precacheOf(folder)).toEqual(first);
    writeFileSync(join(folder, 'assets', 'a.js'), 'abd');
    expect(precacheOf(folder).version).not.toBe(first.version);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('the page may load and connect to what is written here, and nothing else', () => {
  const html = readFileSync(join(ROOT, 'index.html'), 'utf8');
  const policy = /http-equiv="Content-Security-Policy"\s+content="([^"]*)"/.exec(html)?.[1] ?? '';
  const directives = policy.split(';').map((directive) => directive.trim().split(' '));
  expect(Object.fromEntries(directives.map(([name, ...sources]) => [name, sources.sort()]))).toEqual({
    'default-src': ["'none'"],
    'script-src': ["'self'", "'wasm-unsafe-eval'"],
    'worker-src': ["'self'"],
    'connect-src': ["'self'", 'blob:', 'https:'],
    'style-src': ["'self'"],
    'img-src': ["'self'", 'blob:', 'data:'],
    'manifest-src': ["'self'"],
    'font-src': ["'self'"],
    'base-uri': ["'none'"],
  });
});

test('the manifest names icons that are there, in the size that it says', () => {
  const folder = join(ROOT, 'www/public');
  const manifest = JSON.parse(readFileSync(join(folder, 'manifest.webmanifest'), 'utf8')) as {
    readonly start_url: string;
    readonly scope: string;
    readonly icons: readonly { readonly src: string; readonly sizes: string; readonly type: string }[];
  };
  // The paths are relative, so that the page can be installed from any folder.
  expect([manifest.start_url, manifest.scope]).toEqual(['./', './']);
  for (const { src, sizes, type } of manifest.icons) {
    expect(src).toMatch(/^\.\//);
    const bytes = readFileSync(join(folder, src));
    if (type === 'image/png') {
      expect(bytes.subarray(1, 4).toString()).toBe('PNG');
      expect(`${bytes.readUInt32BE(16)}x${bytes.readUInt32BE(20)}`).toBe(sizes);
    }
  }
  expect(manifest.icons.some(({ sizes }) => sizes === '512x512')).toBe(true);
});
