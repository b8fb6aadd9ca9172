/** The list of the built page's files, and how a visit without a network finds them in the cache. */

/** A file of the built page. */
export interface KeptFile {
  /** Its path from the page's folder; empty for the page itself. */
  readonly path: string;
  /** The SHA-256 hash of its bytes in the form that the browser checks: `sha256-` and base64. */
  readonly integrity: string;
}

/** One build of the page, put into the service worker when it is built. */
export interface Precache {
  /** The version, which is different for every build. */
  readonly version: string;
  readonly files: readonly KeptFile[];
}

/** The message by which the page tells a waiting service worker to take over. */
export const TAKE_OVER = 'take over';

/**
 * The beginning of the names of a page's caches. It holds the page's folder, so that two pages of one host do not touch each other's
 * caches.
 */
function prefix(scope: string): string {
  return `conemap ${scope} `;
}

/** The cache of one build of the page in the folder `scope`. */
export function cacheName(scope: string, version: string): string {
  return `${prefix(scope)}${version}`;
}

/**
 * The caches that are no longer needed, from the names of all caches, the oldest first. The cache before the present build's stays: a tab
 * that still shows the older build may ask for parts of it later.
 */
export function outdated(names: readonly string[], scope: string, version: string): string[] {
  const present = cacheName(scope, version);
  const others = names.filter((name) => name.startsWith(prefix(scope)) && name !== present);
  return others.slice(0, -1);
}

/** Whether a file's name changes with its content: the bundler puts all such files into one folder. */
export function isHashed(path: string): boolean {
  return path.startsWith('assets/');
}

/**
 * The path of a request that the cache answers; `null` where the request is for no file of the page. The page itself can be asked for by
 * its folder or by its name, with any query behind a question mark.
 */
export function keptPath(request: Pick<Request, 'method' | 'mode' | 'url'>, scope: string, precache: Precache): string | null {
  if (request.method !== 'GET' || !request.url.startsWith(scope)) {
    return null;
  }
  const rest = request.url.slice(scope.length).replace(/#.*$/, '');
  const path = request.mode === 'navigate' ? rest.replace(/\?.*$/, '').replace(/^index\.html$/, '') : rest;
  const isThere = precache.files.some((file) => file.path === path) && (path !== '' || request.mode === 'navigate');
  return isThere || isHashed(path) ? path : null;
}
