/** Bytes as text that an address can hold: base64url without padding (RFC 4648, section 5). */

/** How many bytes are turned into characters at once; `String.fromCharCode` takes no more arguments than the stack holds. */
const PIECE = 4096;

export function toBase64Url(bytes: Uint8Array): string {
  let characters = '';
  for (let start = 0; start < bytes.length; start += PIECE) {
    characters += String.fromCharCode(...bytes.subarray(start, start + PIECE));
  }
  return btoa(characters).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** The bytes of a text; `null` where it is no base64url. */
export function fromBase64Url(text: string): Uint8Array<ArrayBuffer> | null {
  // One character left over holds six bits, less than a byte.
  if (!/^[\w-]*$/.test(text) || text.length % 4 === 1) {
    return null;
  }
  const characters = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(characters, (character) => character.charCodeAt(0));
}
