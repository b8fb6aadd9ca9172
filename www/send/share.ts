/** What the page sends: the link to what is on it, and what its receiver will see. */
import type { HostFiles } from '../store/receiving.ts';
import type { Link } from './link.ts';
import { writeLink } from './link.ts';
import { foreignFiles } from './receiver.ts';

/** From this length on, in characters, programs that pass links on begin to cut them. */
export const SAFE_LENGTH = 2000;

/** What happens to whoever opens a link. */
export interface Prospect {
  /** Files that must be sent beside the link. */
  readonly needed: readonly string[];
  /** Files that are loaded after a click. */
  readonly loaded: readonly HostFiles[];
  /** Whether the link is so long that it may be cut on its way. */
  readonly isLong: boolean;
}

/** What whoever opens the link at `url` will meet. */
export function prospectOf(link: Link, url: string): Prospect {
  return {
    needed: link.files.flatMap((file) => (file?.kind === 'local' ? [file.name] : [])),
    loaded: foreignFiles(link),
    isLong: url.length > SAFE_LENGTH,
  };
}

/** The whole address of a link, on the page whose address is `base`. */
export function linkAddress(link: Link, base: URL): string {
  const url = new URL(base);
  url.search = '';
  url.hash = writeLink(link);
  return url.href;
}
