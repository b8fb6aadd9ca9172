/** A step of the build: writes the service worker, with the list of all files of the built page, beside the page. */
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, relative, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';
import { build } from 'vite';
import type { KeptFile, Precache } from './precache.ts';

const FILE = 'service-worker.js';
/** A file that some hosts read as settings and none serves. */
const HEADERS = '_headers';
const ENTRY = fileURLToPath(new URL('service-worker.ts', import.meta.url));

function sha256(data: Uint8Array | string, encoding: 'base64' | 'hex'): string {
  return createHash('sha256').update(data).digest(encoding);
}

/** All files of a built page that a host serves, in the order of their paths. */
export function precacheOf(folder: string): Precache {
  const files: KeptFile[] = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(folder, join(entry.parentPath, entry.name)))
    .filter((path) => path !== FILE && path !== HEADERS)
    .sort()
    .map((path) => ({
      path: path === 'index.html' ? '' : path.split(sep).join('/'),
      integrity: `sha256-${sha256(readFileSync(join(folder, path)), 'base64')}`,
    }));
  return { version: sha256(JSON.stringify(files), 'hex').slice(0, 16), files };
}

async function bundled(precache: Precache, target: string | string[]): Promise<string> {
  const output = await build({
    configFile: false,
    publicDir: false,
    logLevel: 'warn',
    define: { PRECACHE: JSON.stringify(precache) },
    build: { target, write: false, modulePreload: false, rolldownOptions: { input: ENTRY, output: { format: 'iife' } } },
  });
  const chunks = [output].flat().flatMap((result) => ('output' in result ? result.output : []));
  const [chunk] = chunks;
  if (chunk?.type !== 'chunk' || chunks.length !== 1) {
    throw new Error('the service worker is not one file');
  }
  return chunk.code;
}

/** Writes the service worker of the built page in this folder, for browsers of this kind. */
export async function writeServiceWorker(folder: string, target: string | string[]): Promise<void> {
  writeFileSync(join(folder, FILE), await bundled(precacheOf(folder), target));
}

/** The plugin for the bundler. It reads the files after they are written, so that the list holds the very bytes that will be served. */
export function serviceWorker(): Plugin {
  let folder = '';
  let target: string | string[] = [];
  return {
    name: 'conemap-service-worker',
    apply: 'build',
    configResolved(config): void {
      folder = resolve(config.root, config.build.outDir);
      target = config.build.target === false ? 'es2022' : config.build.target;
    },
    closeBundle: {
      order: 'post',
      sequential: true,
      async handler(): Promise<void> {
        await writeServiceWorker(folder, target);
      },
    },
  };
}
