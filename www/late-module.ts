/** Modules of the page that are fetched when they are first needed, and again after a failure. */

/**
 * The address of the module that did not load, as Chromium and Firefox write it into their errors; null where the error has none, or where
 * the address is not in the folder of the page's own modules, of which `own` is one.
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
 * A loader that can be called until it succeeds. A browser remembers that a module did not load and refuses its address until the page is
 * reloaded, so each further try uses another address.
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
