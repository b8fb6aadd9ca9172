/** Packs text for an address by raw deflate (RFC 1951) and base64url, and unpacks it again within limits. */
import { deflateSync, Inflate } from 'fflate';
import { fromBase64Url, toBase64Url } from './base64url.ts';

/** The number of packed bytes that are inflated at once. Each gives at most 1032 bytes, so the limit is exceeded by at most 2 MB. */
const PIECE = 2048;

export function pack(text: string): string {
  return toBase64Url(deflateSync(new TextEncoder().encode(text), { level: 9 }));
}

/** The unpacked bytes; `null` where the packed ones are damaged, end too early, or give more than `limit` bytes. */
function inflated(packed: Uint8Array, limit: number): Uint8Array | null {
  const pieces: Uint8Array[] = [];
  const come = { size: 0, isWhole: false };
  const stream = new Inflate((piece, final) => {
    pieces.push(piece);
    come.size += piece.length;
    come.isWhole = final;
  });
  try {
    for (let start = 0; start < packed.length && come.size <= limit; start += PIECE) {
      const end = start + PIECE;
      stream.push(packed.subarray(start, end), end >= packed.length);
    }
  } catch {
    return null;
  }
  if (!come.isWhole || come.size > limit) {
    return null;
  }
  const bytes = new Uint8Array(come.size);
  let end = 0;
  for (const piece of pieces) {
    bytes.set(piece, end);
    end += piece.length;
  }
  return bytes;
}

/** The text that was packed; `null` where there is none, or where it has more than `limit` bytes. */
export function unpack(packed: string, limit: number): string | null {
  const bytes = fromBase64Url(packed);
  const text = bytes === null ? null : inflated(bytes, limit);
  try {
    return text === null ? null : new TextDecoder('utf-8', { fatal: true }).decode(text);
  } catch {
    return null;
  }
}
