/** Modules of the page that are fetched when they are first wanted, and asked for again where they did not come. */

/**
 * Where the module lies that did not come, as Chromium and Firefox say in their errors; null where that is not told, or does not lie
 * in the folder of the page's own modules, of which `own` is one.
 */
export function missingModule(thrown: unknown, own: string): URL | null {
  const told = thrown instanceof Error ? /https?:\S+\.js\b/.exec(thrown.message)?.[0] : undefined;
  if (told === undefined) {
    return null;
  }
  const address = new URL(told);
  return address.href.startsWith(new URL('.', own).href) ? address : null;
}

/**
 * A loader that can be called until it succeeds. A browser remembers that a module did not come and refuses its address until the
 * page is reloaded, so each further try asks under another one.
 */
export function lateModule<M>(
  load: () => Promise<M>,
  own: string = import.meta.url,
  fetched: (address: string) => Promise<M> = (address) => import(/* @vite-ignore */ address) as Promise<M>,
): () => Promise<M> {
  let missing: URL | null = null;
  let tries = 0;
  return async () => {
    tries += 1;
    try {
      return await (missing === null ? load() : fetched(`${missing.href}?try=${String(tries)}`));
    } catch (thrown) {
      missing ??= missingModule(thrown, own);
      throw thrown;
    }
  };
}
