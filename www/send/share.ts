/** Makes the link to what is on the page, and foresees what its receiver will see. */
import type { HostFiles } from '../store/receiving.ts';
import type { Link } from './link.ts';
import { writeLink } from './link.ts';
import { foreignFiles } from './receiver.ts';

/** The length of a link, in characters, from which on some programs that pass links on cut them. */
export const SAFE_LENGTH = 2000;

/** What a link will ask of whoever opens it. */
export interface Prospect {
  /** The names of the files that must be sent beside the link. */
  readonly needed: readonly string[];
  /** The files that are loaded after a click, by host. */
  readonly loaded: readonly HostFiles[];
  /** Whether the link is so long that some programs may cut it. */
  readonly isLong: boolean;
}

/** What the link at `url` will ask of whoever opens it. */
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
