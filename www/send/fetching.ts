/** Fetches the files that a link names: without credentials or referrer, limited in size, and stopped on demand. */
import type { Address } from './address.ts';

/** The most bytes that one file of a link may have. */
export const LARGEST_FETCHED = 256 * 1024 * 1024;

/** Why a file was not fetched; `status` is the server's answer where it gave one. */
export type FetchFault =
  | { readonly kind: 'unreachable' }
  | { readonly kind: 'moved' }
  | { readonly kind: 'status'; readonly status: number }
  | { readonly kind: 'too-large' }
  | { readonly kind: 'cancelled' };

/** A file that could not be fetched. */
export class FetchRefused extends Error {
  readonly fault: FetchFault;
  readonly address: Address;

  constructor(fault: FetchFault, address: Address) {
    super(`${address.url}: ${fault.kind}`);
    this.fault = fault;
    this.address = address;
  }
}

/** The terms of a fetch: how it is stopped, and who hears of its progress. */
export interface FetchTerms {
  readonly signal: AbortSignal;
  /** Hears of the bytes that have come, and of how many are expected; `null` where the server does not say. */
  readonly progress: (loaded: number, expected: number | null) => void;
}

/** The length that the server states, which may be wrong; `null` where it states none. */
function toldLength(response: Response): number | null {
  const told = response.headers.get('content-length');
  return told !== null && /^\d{1,15}$/.test(told) ? Number(told) : null;
}

async function answer(address: Address, signal: AbortSignal): Promise<Response> {
  const response = await fetch(address.url, {
    credentials: 'omit',
    referrerPolicy: 'no-referrer',
    // A user who has agreed to one host has not agreed to the one that it redirects to, and the browser does not say which that is.
    redirect: 'manual',
    signal,
  });
  const refuse = async (fault: FetchFault): Promise<never> => {
    await response.body?.cancel();
    throw new FetchRefused(fault, address);
  };
  if (response.type === 'opaqueredirect') {
    return refuse({ kind: 'moved' });
  }
  if (!response.ok) {
    return refuse({ kind: 'status', status: response.status });
  }
  if ((toldLength(response) ?? 0) > LARGEST_FETCHED) {
    return refuse({ kind: 'too-large' });
  }
  return response;
}

async function bodyOf(response: Response, address: Address, terms: FetchTerms): Promise<Uint8Array<ArrayBuffer>> {
  const expected = toldLength(response);
  const pieces: Uint8Array[] = [];
  let size = 0;
  const reader = response.body?.getReader();
  for (let next = await reader?.read(); next?.done === false; next = await reader?.read()) {
    pieces.push(next.value);
    size += next.value.length;
    if (size > LARGEST_FETCHED) {
      await reader?.cancel();
      throw new FetchRefused({ kind: 'too-large' }, address);
    }
    // A compressed file grows beyond the stated length when it is unpacked.
    terms.progress(size, expected !== null && size <= expected ? expected : null);
  }
  const bytes = new Uint8Array(size);
  let end = 0;
  for (const piece of pieces) {
    bytes.set(piece, end);
    end += piece.length;
  }
  return bytes;
}

/** The bytes at an address. Throws {@link FetchRefused}. */
export async function fetchBytes(address: Address, terms: FetchTerms): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return await bodyOf(await answer(address, terms.signal), address, terms);
  } catch (thrown) {
    if (thrown instanceof FetchRefused) {
      throw thrown;
    }
    // The browser reports a host that does not answer and one that forbids other pages to read its files in the same way.
    throw new FetchRefused({ kind: terms.signal.aborted ? 'cancelled' : 'unreachable' }, address);
  }
}
