/** What tells one file from another: SHA-256. */
import { toBase64Url } from './base64url.ts';

/** The hash of a file as 43 characters of base64url; `null` where the page came by an open line and may not ask for it. */
export async function hashOf(bytes: Uint8Array): Promise<string | null> {
  // Browsers give it to pages that came by https or from the machine itself.
  const { subtle } = globalThis.crypto as { readonly subtle?: SubtleCrypto };
  // The page shares no memory between threads: the bytes can only be in a plain buffer.
  return subtle === undefined ? null : toBase64Url(new Uint8Array(await subtle.digest('SHA-256', bytes as Uint8Array<ArrayBuffer>)));
}
