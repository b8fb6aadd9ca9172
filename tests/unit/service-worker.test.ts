/** The service worker as the build writes it, with a simulated browser. */
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { precacheOf, writeServiceWorker } from '../../www/offline/build.ts';
import { cacheName, TAKE_OVER } from '../../www/offline/precache.ts';

const SCOPE = 'https://a.b/tools/conemap/';

/** A cache storage that holds its entries in order. */
class Caches {
  readonly held = new Map<string, Map<string, Response>>();

  async keys(): Promise<string[]> {
    return Promise.resolve([...this.held.keys()]);
  }

  async open(name: string): Promise<{ put: (url: string, response: Response) => Promise<void>; match: (url: string) => Promise<Response | undefined> }> {
    const entries = this.held.get(name) ?? new Map<string, Response>();
    this.held.set(name, entries);
    return Promise.resolve({
      put: async (url, response) => {
        entries.set(url, response);
        return Promise.resolve();
      },
      match: async (url) => Promise.resolve(entries.get(url)?.clone()),
    });
  }

  async match(url: string): Promise<Response | undefined> {
    return Promise.resolve([...this.held.values()].map((entries) => entries.get(url)).find((found) => found !== undefined)?.clone());
  }

  async delete(name: string): Promise<boolean> {
    return Promise.resolve(this.held.delete(name));
  }
}

interface Started {
  readonly install: () => Promise<unknown>;
  readonly activate: () => Promise<unknown>;
  /** The answer to a request; `undefined` where the worker leaves it to the browser. */
  readonly ask: (path: string, mode?: RequestMode) => Promise<string> | undefined;
  readonly tell: (data: unknown) => void;
  readonly counts: { claimed: number; skipped: number };
}

/** Runs the worker's code with these caches and this network. */
function started(code: string, caches: Caches, fetch: (url: string, options?: RequestInit) => Promise<Response>): Started {
  const listeners = new Map<string, (event: unknown) => void>();
  const counts = { claimed: 0, skipped: 0 };
  const worker = {
    registration: { scope: SCOPE },
    clients: {
      claim: async () => {
        counts.claimed++;
        return Promise.resolve();
      },
    },
    skipWaiting: async () => {
      counts.skipped++;
      return Promise.resolve();
    },
    addEventListener: (kind: string, listener: (event: unknown) => void) => listeners.set(kind, listener),
  };
  // eslint-disable-next-line @typescript-eslint/no-implied-eval -- as a browser runs the file that was built
  (new Function('self', 'caches', 'fetch', code) as (self: unknown, caches: Caches, fetch: unknown) => void)(worker, caches, (asked: string | { url: string }, options?: RequestInit) =>
    fetch(typeof asked === 'string' ? asked : asked.url, options),
  );
  const waited = async (kind: string): Promise<unknown> => {
    let work: Promise<unknown> = Promise.resolve();
    listeners.get(kind)?.({ waitUntil: (promise: Promise<unknown>) => (work = promise) });
    return work;
  };
  return {
    install: async () => waited('install'),
    activate: async () => waited('activate'),
    ask: (path, mode = 'cors') => {
      let answer: Promise<Response> | undefined;
      const request = { url: new URL(path, SCOPE).href, mode, method: 'GET' };
      listeners.get('fetch')?.({ request, respondWith: (promise: Promise<Response>) => (answer = promise) });
      return answer?.then((response) => response.text());
    },
    tell: (data) => listeners.get('message')?.({ data }),
    counts,
  };
}

const offline = async (): Promise<Response> => Promise.reject(new TypeError('no network'));

describe('the service worker', { timeout: 60_000 }, () => {
  let folder = '';
  let code = '';
  /** A network that gives the built files and records the requests. */
  const asked: string[] = [];
  const net = async (url: string, options?: RequestInit): Promise<Response> => {
    const path = url.slice(SCOPE.length);
    asked.push(`${path} ${options?.cache ?? ''}`.trim());
    const file = precacheOf(folder).files.find((candidate) => candidate.path === path);
    expect(options?.integrity).toBe(file?.integrity);
    return Promise.resolve(new Response(readFileSync(join(folder, path === '' ? 'index.html' : path))));
  };

  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), 'conemap-'));
    mkdirSync(join(folder, 'assets'));
    writeFileSync(join(folder, 'index.html'), 'the page');
    writeFileSync(join(folder, 'icon.svg'), 'an icon');
    writeFileSync(join(folder, 'assets', 'index-1.js'), 'a script');
    await writeServiceWorker(folder, 'es2022');
    code = readFileSync(join(folder, 'service-worker.js'), 'utf8');
  });
  afterAll(() => {
    rmSync(folder, { recursive: true });
  });

  test('keeps every file of the build, checked, and then needs no network', async () => {
    const caches = new Caches();
    const { install, activate, counts } = started(code, caches, net);
    await install();
    await activate();
    expect(asked.sort()).toEqual(['assets/index-1.js default', 'icon.svg no-cache', 'no-cache']);
    expect(counts).toEqual({ claimed: 1, skipped: 0 });
    const later = started(code, caches, offline);
    expect(await later.ask('', 'navigate')).toBe('the page');
    expect(await later.ask('index.html?a=b', 'navigate')).toBe('the page');
    expect(await later.ask('assets/index-1.js')).toBe('a script');
    expect(await later.ask('icon.svg')).toBe('an icon');
    expect(later.ask('https://data.example/cat.obj')).toBeUndefined();
    expect(later.ask('mesh.obj')).toBeUndefined();
  });

  test('asks again for a file that broke off, past what the browser has of it', async () => {
    const caches = new Caches();
    const broken = new Set(['assets/index-1.js default', 'no-cache']);
    const flaky = async (url: string, options?: RequestInit): Promise<Response> => {
      const request = `${url.slice(SCOPE.length)} ${options?.cache ?? ''}`.trim();
      return broken.delete(request) ? Promise.reject(new TypeError('broke off')) : net(url, options);
    };
    asked.length = 0;
    await started(code, caches, flaky).install();
    expect(asked.sort()).toEqual(['assets/index-1.js reload', 'icon.svg no-cache', 'reload']);
    expect(await started(code, caches, offline).ask('assets/index-1.js')).toBe('a script');
  });

  test('is not installed by halves', async () => {
    const missing = async (url: string): Promise<Response> => Promise.resolve(new Response('', { status: url.endsWith('.svg') ? 404 : 200 }));
    await expect(started(code, new Caches(), missing).install()).rejects.toThrow('404');
  });

  test('takes what has not changed from the build before, keeps that one, and drops older ones', async () => {
    const caches = new Caches();
    const earlier = await caches.open(cacheName(SCOPE, 'older'));
    await earlier.put(`${SCOPE}assets/index-0.js`, new Response('long gone'));
    const before = await caches.open(cacheName(SCOPE, 'before'));
    await before.put(`${SCOPE}assets/index-1.js`, new Response('a script'));
    await before.put(`${SCOPE}assets/index-0.js`, new Response('an old part'));
    await before.put(SCOPE, new Response('the old page'));
    asked.length = 0;
    const { install, activate } = started(code, caches, net);
    await install();
    expect(asked.sort()).toEqual(['icon.svg no-cache', 'no-cache']);
    await activate();
    expect([...caches.held.keys()]).toEqual([cacheName(SCOPE, 'before'), cacheName(SCOPE, precacheOf(folder).version)]);
    const later = started(code, caches, offline);
    expect(await later.ask('', 'navigate')).toBe('the page');
    // A tab that still shows the earlier build finds the parts of it.
    expect(await later.ask('assets/index-0.js')).toBe('an old part');
  });

  test('takes over when it is told to, and at no other word', () => {
    const { tell, counts } = started(code, new Caches(), offline);
    tell('anything');
    expect(counts.skipped).toBe(0);
    tell(TAKE_OVER);
    expect(counts.skipped).toBe(1);
  });
});
