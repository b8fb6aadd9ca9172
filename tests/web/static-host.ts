/** A plain static web server like any host: it serves the files of a folder under a path, and further answers that a test adds. */
import { createReadStream, statSync } from 'node:fs';
import type { IncomingMessage, ServerResponse } from 'node:http';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const TYPES: Readonly<Record<string, string>> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.webmanifest': 'application/manifest+json',
};

/** The answer to a further path. */
export type Extra = (request: IncomingMessage, response: ServerResponse) => void;

export interface StaticHost {
  /** The address of the page, with a slash at the end. */
  readonly address: string;
  /** The paths that were requested, in order. */
  readonly asked: readonly string[];
  /** Serves this folder from now on. */
  serve(folder: string): void;
  close(): Promise<void>;
}

/** Serves a folder under `path`, which begins and ends with a slash; `extras` by their full paths. */
export async function staticHost(folder: string, path: string, extras: Readonly<Record<string, Extra>> = {}): Promise<StaticHost> {
  let served = folder;
  const asked: string[] = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    asked.push(pathname);
    const extra = extras[pathname];
    if (extra !== undefined) {
      extra(request, response);
      return;
    }
    const rest = pathname.startsWith(path) ? decodeURIComponent(pathname.slice(path.length)) : null;
    const file = rest === null ? '' : join(served, normalize(`/${rest === '' ? 'index.html' : rest}`));
    if (rest === null || statSync(file, { throwIfNoEntry: false })?.isFile() !== true) {
      response.writeHead(404).end('not here');
      return;
    }
    response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream', 'cache-control': 'max-age=600' });
    createReadStream(file).pipe(response);
  });
  const port = await new Promise<number>((resolve) => {
    server.listen(0, '127.0.0.1', () => {
      const bound = server.address();
      resolve(bound !== null && typeof bound === 'object' ? bound.port : 0);
    });
  });
  return {
    address: `http://127.0.0.1:${port}${path}`,
    asked,
    serve: (other) => {
      served = other;
    },
    close: async () =>
      new Promise((resolve) => {
        server.close(() => {
          resolve();
        });
        server.closeAllConnections();
      }),
  };
}
