/** What the built page consists of, and where a visit without a network finds it. */

/** A file of the built page. */
export interface KeptFile {
  /** Its path from the page's folder; empty for the page itself. */
  readonly path: string;
  /** SHA-256 of its bytes as the browser checks it: `sha256-` and base64. */
  readonly integrity: string;
}

/** One build of the page, put into the service worker when it is built. */
export interface Precache {
  /** Tells builds apart. */
  readonly version: string;
  readonly files: readonly KeptFile[];
}

/** What the page says to a service worker that waits for its turn. */
export const TAKE_OVER = 'take over';

/** Names of the caches of one page: two pages of one host, in different folders, leave each other alone. */
function prefix(scope: string): string {
  return `conemap ${scope} `;
}

/** The cache of one build of the page in the folder `scope`. */
export function cacheName(scope: string, version: string): string {
  return `${prefix(scope)}${version}`;
}

/**
 * The caches that nobody needs, from all in the order of their making. Beside the present build's the one before it
 * stays: a tab that still shows it may ask for its later parts.
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
 * The path of a request that the cache answers; `null` where it is none of the page's files. The page itself is asked for
 * by its folder or by its name, with whatever behind a question mark.
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
