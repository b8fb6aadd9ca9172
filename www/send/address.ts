/** Addresses of files in links: which are taken, what their files are called, and whom they belong to. */

/** Longer ones are no addresses of files that people put somewhere. */
export const LONGEST_ADDRESS = 2048;
const LONGEST_NAME = 80;

/** Why an address is not taken. */
export type AddressFault = 'no-address' | 'too-long' | 'not-https' | 'has-password';

/** A file somewhere else. */
export interface Address {
  /** In full. */
  readonly url: string;
  /** The file's name to show: the last part of the path, without characters that are not seen or turn the text around. */
  readonly name: string;
  /** Whom it is fetched from, by name and port; `null` where that is the page's own host. */
  readonly host: string | null;
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** A name that comes from outside, as it can be shown: one line, no controls, of bounded length. */
export function shownName(name: string): string {
  const seen = name.replace(/[\p{C}\p{Zl}\p{Zp}]/gu, '').trim();
  const last = seen.slice(Math.max(seen.lastIndexOf('/'), seen.lastIndexOf('\\')) + 1);
  const characters = Array.from(last);
  return characters.length <= LONGEST_NAME ? last : `${characters.slice(0, LONGEST_NAME - 1).join('')}…`;
}

/**
 * The address that a text means, relative to the page's own `base`. Only https is taken, and whatever the page itself
 * came by.
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
