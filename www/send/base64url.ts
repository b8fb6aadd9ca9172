/** Bytes as text that an address can hold: base64url without padding (RFC 4648, section 5). */

/** The number of bytes that are converted at once; `String.fromCharCode` takes only as many arguments as the stack holds. */
const PIECE = 4096;

export function toBase64Url(bytes: Uint8Array): string {
  let characters = '';
  for (let start = 0; start < bytes.length; start += PIECE) {
    characters += String.fromCharCode(...bytes.subarray(start, start + PIECE));
  }
  return btoa(characters).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** The bytes of a text; `null` where it is not base64url. */
export function fromBase64Url(text: string): Uint8Array<ArrayBuffer> | null {
  // A single character that is left over holds six bits, which is less than a byte.
  if (!/^[\w-]*$/.test(text) || text.length % 4 === 1) {
    return null;
  }
  const characters = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(characters, (character) => character.charCodeAt(0));
}
