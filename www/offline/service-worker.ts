/**
 * The service worker, which keeps the built page for visits without a network. When a build is first met, all its files are fetched once
 * and checked against their hashes; from then on they come from the cache, all from one build. A new build waits until every tab of the old
 * one is closed, or until the page tells it to take over.
 */
import { cacheName, isHashed, keptPath, outdated, TAKE_OVER } from './precache.ts';
import type { KeptFile, Precache } from './precache.ts';

/** The list of files, which the build inserts here. */
declare const PRECACHE: Precache;

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
const NAME = cacheName(scope, PRECACHE.version);
/** Servers say that files vary with the headers of the request (`Vary`); the page's files do not. */
const ANY_VARIANT = { ignoreVary: true };

/** A file from the server; `cache` says how far the browser's own cache may answer. */
async function fetched({ path, integrity }: KeptFile, cache: RequestCache): Promise<Response> {
  const url = `${scope}${path}`;
  const response = await fetch(url, { integrity, cache });
  if (!response.ok) {
    throw new Error(`${url}: ${response.status}`);
  }
  // Browsers refuse to show a page from a cached response that is marked as redirected, so the mark is removed.
  return response.redirected ? new Response(response.body, { headers: response.headers }) : response;
}

/** Puts a file from the server into the cache. Where the file's name holds its hash, a copy from an earlier build is used instead. */
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
    // One broken download among many must not fail the whole; the second try bypasses the browser's cache, which may hold a part of the
    // file.
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
