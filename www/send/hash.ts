/** The hash by which files are told apart: SHA-256. */
import { toBase64Url } from './base64url.ts';

/** The hash of a file as 43 characters of base64url; `null` where the browser computes none, because the page was loaded by http. */
export async function hashOf(bytes: Uint8Array): Promise<string | null> {
  // Browsers offer this to pages that were loaded by https or from the machine itself.
  const { subtle } = globalThis.crypto as { readonly subtle?: SubtleCrypto };
  // The page shares no memory between threads, so the bytes are never in a shared buffer.
  return subtle === undefined ? null : toBase64Url(new Uint8Array(await subtle.digest('SHA-256', bytes as Uint8Array<ArrayBuffer>)));
}
