/** Addresses of files in links: which are accepted, the names of their files, and the hosts that they belong to. */

/** The most characters of an address; files that people share have shorter ones. */
export const LONGEST_ADDRESS = 2048;
const LONGEST_NAME = 80;

/** Why an address is not accepted. */
export type AddressFault = 'no-address' | 'too-long' | 'not-https' | 'has-password';

/** A file at an address that is accepted. */
export interface Address {
  /** The full address. */
  readonly url: string;
  /**
   * The name of the file that is shown: the last part of the path, without invisible characters and those that change the direction of the
   * text.
   */
  readonly name: string;
  /** The name and port of the host from which it is fetched; `null` for the page's own host. */
  readonly host: string | null;
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** A name that comes from outside, made fit to be shown: one line of bounded length, without control characters. */
export function shownName(name: string): string {
  const seen = name.replace(/[\p{C}\p{Zl}\p{Zp}]/gu, '').trim();
  const last = seen.slice(Math.max(seen.lastIndexOf('/'), seen.lastIndexOf('\\')) + 1);
  const characters = Array.from(last);
  return characters.length <= LONGEST_NAME ? last : `${characters.slice(0, LONGEST_NAME - 1).join('')}…`;
}

/**
 * The address that a text gives, relative to the page's own `base`. Only https is accepted, and whatever protocol the page itself came by
 * for files of its own host.
 */
export function addressOf(text: string, base: URL): Address | AddressFault {
  if (text.length > LONGEST_ADDRESS) {
    return 'too-long';
  }
  const url = parsed(text, base);
  if (url === null || text.trim() === '') {
    return 'no-address';
  }
  const isOwn = url.origin === base.origin && url.origin !== 'null';
  if (!isOwn && url.protocol !== 'https:') {
    return 'not-https';
  }
  if (url.username !== '' || url.password !== '') {
    return 'has-password';
  }
  url.hash = '';
  const name = shownName(unescaped(url.pathname.slice(url.pathname.lastIndexOf('/') + 1)));
  return { url: url.href, name: name === '' ? 'file' : name, host: isOwn ? null : url.host };
}

function parsed(text: string, base: URL): URL | null {
  try {
    return new URL(text, base);
  } catch {
    return null;
  }
}
