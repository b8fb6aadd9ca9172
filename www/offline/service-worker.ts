/**
 * Keeps the built page for visits without a network. All its files are fetched once when a build is first met and checked
 * against their hashes; from then on they come from the cache, all from one build. A new build waits until every tab of the
 * old one is closed, or until the page says that it may take over.
 */
import { cacheName, isHashed, keptPath, outdated, TAKE_OVER } from './precache.ts';
import type { KeptFile, Precache } from './precache.ts';

/** Put here by the build. */
declare const PRECACHE: Precache;

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
const NAME = cacheName(scope, PRECACHE.version);
/** Servers say of files that they vary with what the browser takes; the page's do not. */
const ANY_VARIANT = { ignoreVary: true };

/** The file as the server has it; how the browser's own cache may answer for it is told by `cache`. */
async function fetched({ path, integrity }: KeptFile, cache: RequestCache): Promise<Response> {
  const url = `${scope}${path}`;
  const response = await fetch(url, { integrity, cache });
  if (!response.ok) {
    throw new Error(`${url}: ${response.status}`);
  }
  // A browser shows no page whose copy says that it was reached by a detour.
  return response.redirected ? new Response(response.body, { headers: response.headers }) : response;
}

/** Keeps the file as the server has it now; of a file whose name holds its hash, an earlier build's copy is as good. */
async function keep(cache: Cache, file: KeptFile): Promise<void> {
  const url = `${scope}${file.path}`;
  const earlier = isHashed(file.path) ? await caches.match(url, ANY_VARIANT) : undefined;
  if (earlier !== undefined) {
    await cache.put(url, earlier);
    return;
  }
  try {
    await cache.put(url, await fetched(file, isHashed(file.path) ? 'default' : 'no-cache'));
  } catch {
    // One answer of many that broke off is not the end of all; this one passes by what the browser may have half of.
    await cache.put(url, await fetched(file, 'reload'));
  }
}

async function fill(): Promise<void> {
  const cache = await caches.open(NAME);
  await Promise.all(PRECACHE.files.map((file) => keep(cache, file)));
}

async function begin(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(outdated(names, scope, PRECACHE.version).map((name) => caches.delete(name)));
  await worker.clients.claim();
}

async function kept(path: string, request: Request): Promise<Response> {
  const url = `${scope}${path}`;
  const present = await (await caches.open(NAME)).match(url, ANY_VARIANT);
  const found = present ?? (isHashed(path) ? await caches.match(url, ANY_VARIANT) : undefined);
  return found ?? fetch(request);
}

worker.addEventListener('install', (event) => {
  event.waitUntil(fill());
});
worker.addEventListener('activate', (event) => {
  event.waitUntil(begin());
});
worker.addEventListener('message', (event) => {
  if (event.data === TAKE_OVER) {
    void worker.skipWaiting();
  }
});
worker.addEventListener('fetch', (event) => {
  const path = keptPath(event.request, scope, PRECACHE);
  if (path !== null) {
    event.respondWith(kept(path, event.request));
  }
});
