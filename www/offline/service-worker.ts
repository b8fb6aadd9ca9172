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

/** The file as the server has it now; of a file whose name holds its hash, an earlier build's copy is as good. */
async function fetched({ path, integrity }: KeptFile): Promise<Response> {
  const url = `${scope}${path}`;
  const earlier = isHashed(path) ? await caches.match(url, ANY_VARIANT) : undefined;
  if (earlier !== undefined) {
    return earlier;
  }
  const response = await fetch(url, { integrity, cache: isHashed(path) ? 'default' : 'no-cache' });
  if (!response.ok) {
    throw new Error(`${url}: ${response.status}`);
  }
  // A browser shows no page whose copy says that it was reached by a detour.
  return response.redirected ? new Response(response.body, { headers: response.headers }) : response;
}

async function fill(): Promise<void> {
  const cache = await caches.open(NAME);
  await Promise.all(PRECACHE.files.map(async (file) => cache.put(`${scope}${file.path}`, await fetched(file))));
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
