/** Files fetched from other hosts: the terms of the request, and the end of each fault. */
import { afterEach, describe, expect, test, vi } from 'vitest';
import type { Address } from '../../../www/send/address.ts';
import { fetchBytes, FetchRefused, LARGEST_FETCHED } from '../../../www/send/fetching.ts';

const CAT: Address = { url: 'https://data.example/cat.obj', name: 'cat.obj', host: 'data.example' };

/** A server that gives this answer and records the requests. */
function answering(answer: () => Response | Promise<Response>): { readonly asked: RequestInit[] } {
  const asked: RequestInit[] = [];
  vi.stubGlobal('fetch', async (_: string, options: RequestInit) => {
    asked.push(options);
    return answer();
  });
  return { asked };
}

/** A body that never ends by itself; `taken` counts the bytes that were read. */
function endless(piece: number): { readonly body: ReadableStream<Uint8Array>; readonly taken: () => number; readonly isCancelled: () => boolean } {
  let taken = 0;
  let cancelled = false;
  const bytes = new Uint8Array(piece);
  const body = new ReadableStream<Uint8Array>({
    pull(controller) {
      taken += piece;
      controller.enqueue(bytes);
    },
    cancel() {
      cancelled = true;
    },
  });
  return { body, taken: () => taken, isCancelled: () => cancelled };
}

async function faultOf(work: Promise<unknown>): Promise<unknown> {
  return work.then(
    () => 'none',
    (thrown: unknown) => (thrown instanceof FetchRefused ? thrown.fault : thrown),
  );
}

function terms(): { signal: AbortSignal; progress: ReturnType<typeof vi.fn<(loaded: number, expected: number | null) => void>>; stop: () => void } {
  const controller = new AbortController();
  return {
    signal: controller.signal,
    progress: vi.fn<(loaded: number, expected: number | null) => void>(),
    stop: () => {
      controller.abort();
    },
  };
}

afterEach(() => {
  vi.unstubAllGlobals();
});

describe('a file', () => {
  test('is asked for without credentials or referrer, and comes whole', async () => {
    const text = 'v 0 0 0\n'.repeat(5000);
    const { asked } = answering(() => new Response(text, { headers: { 'content-length': String(text.length) } }));
    const given = terms();
    expect(new TextDecoder().decode(await fetchBytes(CAT, given))).toBe(text);
    expect(asked).toEqual([{ credentials: 'omit', referrerPolicy: 'no-referrer', redirect: 'manual', signal: given.signal }]);
    expect(given.progress).toHaveBeenLastCalledWith(text.length, text.length);
  });

  test('may be empty, or longer than was told', async () => {
    answering(() => new Response(null));
    expect(await fetchBytes(CAT, terms())).toHaveLength(0);
    answering(() => new Response('longer', { headers: { 'content-length': '3' } }));
    const given = terms();
    expect(await fetchBytes(CAT, given)).toHaveLength(6);
    expect(given.progress).toHaveBeenLastCalledWith(6, null);
  });

  test('that is told to be too large is not begun', async () => {
    const { body, taken, isCancelled } = endless(1024);
    answering(() => new Response(body, { headers: { 'content-length': String(LARGEST_FETCHED + 1) } }));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'too-large' });
    expect(taken()).toBeLessThanOrEqual(2048);
    expect(isCancelled()).toBe(true);
  });

  test('that turns out too large is given up at once', async () => {
    const piece = 16 * 1024 * 1024;
    const { body, taken, isCancelled } = endless(piece);
    answering(() => new Response(body, { headers: { 'content-length': '5' } }));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'too-large' });
    expect(taken()).toBeLessThanOrEqual(LARGEST_FETCHED + 3 * piece);
    expect(isCancelled()).toBe(true);
  });

  test('that is not there, is elsewhere or is not given says so', async () => {
    answering(() => new Response('no', { status: 404 }));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'status', status: 404 });
    answering(() => Object.defineProperty(new Response(null), 'type', { value: 'opaqueredirect' }));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'moved' });
    answering(() => Promise.reject(new TypeError('Failed to fetch')));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'unreachable' });
  });

  test('that breaks off on its way is no file', async () => {
    let sent = false;
    const body = new ReadableStream<Uint8Array>({
      pull(controller) {
        if (sent) {
          controller.error(new TypeError('network'));
        } else {
          sent = true;
          controller.enqueue(new Uint8Array(10));
        }
      },
    });
    answering(() => new Response(body));
    expect(await faultOf(fetchBytes(CAT, terms()))).toEqual({ kind: 'unreachable' });
  });

  test('is given up at a word', async () => {
    const given = terms();
    const { body } = endless(1024);
    answering(() => new Response(body));
    given.progress.mockImplementation(() => {
      given.stop();
    });
    // Unlike the browser's, this body is not connected to the signal by itself.
    vi.stubGlobal('fetch', async (_: string, { signal }: RequestInit) => {
      const stream = new ReadableStream<Uint8Array>({
        pull(controller) {
          if (signal?.aborted === true) {
            controller.error(signal.reason);
          } else {
            controller.enqueue(new Uint8Array(1024));
          }
        },
      });
      return Promise.resolve(new Response(stream));
    });
    expect(await faultOf(fetchBytes(CAT, given))).toEqual({ kind: 'cancelled' });
  });
});
