/** The client of a saved map: every question gets its own answer, and none is left waiting. */
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { openSavedMap, SavedMapError } from '../../www/compute/saved-client.ts';
import type { SavedAnswer, SavedRequest } from '../../www/compute/saved-messages.ts';

type Listener = (event: { readonly data?: SavedAnswer; readonly message?: string; preventDefault(): void }) => void;

class FakeWorker {
  static last: FakeWorker | null = null;
  readonly asked: SavedRequest[] = [];
  terminated = false;
  private readonly listeners = new Map<string, Listener>();

  constructor() {
    FakeWorker.last = this;
  }

  addEventListener(kind: string, listener: Listener): void {
    this.listeners.set(kind, listener);
  }

  postMessage(request: SavedRequest): void {
    this.asked.push(request);
  }

  terminate(): void {
    this.terminated = true;
  }

  answer(data: SavedAnswer): void {
    this.listeners.get('message')?.({ data, preventDefault: () => undefined });
  }

  fail(message: string): void {
    this.listeners.get('error')?.({ message, preventDefault: () => undefined });
  }
}

function worker(): FakeWorker {
  if (FakeWorker.last === null) {
    throw new Error('no worker was started');
  }
  return FakeWorker.last;
}

const MODULE = {} as WebAssembly.Module;
const FILES = { map: new Uint8Array([1]), source: new Uint8Array([2]), target: new Uint8Array([3]) };

beforeEach(() => {
  vi.stubGlobal('Worker', FakeWorker);
});

afterEach(() => {
  vi.unstubAllGlobals();
});

test('answers reach the question that they belong to, in any order', async () => {
  const map = openSavedMap(MODULE, FILES, 'files');
  const [first, second] = [map.file('layout.svg'), map.file('map.conemap')];
  expect(worker().asked.map(({ kind, id }) => [kind, id])).toEqual([
    ['open', 0],
    ['file', 1],
    ['file', 2],
  ]);
  worker().answer({ kind: 'file', id: 2, bytes: new Uint8Array([22]) });
  worker().answer({ kind: 'file', id: 1, bytes: new Uint8Array([11]) });
  worker().answer({ kind: 'opened', id: 0, opened: null });
  expect(await Promise.all([first, second, map.opened])).toEqual([new Uint8Array([11]), new Uint8Array([22]), null]);
});

test('a failure names its code and the mesh at fault', async () => {
  const map = openSavedMap(MODULE, FILES, 'views');
  worker().answer({ kind: 'failed', id: 0, failure: { code: 'other-meshes', message: 'another mesh', side: 'target' } });
  const error: unknown = await map.opened.catch((thrown: unknown) => thrown);
  expect(error).toBeInstanceOf(SavedMapError);
  expect((error as SavedMapError).failure).toEqual({ code: 'other-meshes', message: 'another mesh', side: 'target' });
});

test('a worker that breaks or is closed leaves no question waiting', async () => {
  const broken = openSavedMap(MODULE, FILES, 'files');
  const asked = broken.file('layout.svg').catch((thrown: unknown) => thrown);
  const opened = broken.opened.catch((thrown: unknown) => thrown);
  worker().fail('out of memory');
  expect(((await asked) as SavedMapError).failure.code).toBe('worker');
  expect(((await opened) as SavedMapError).message).toBe('out of memory');
  expect(worker().terminated).toBe(true);
  await expect(broken.file('map.conemap')).rejects.toMatchObject({ failure: { code: 'worker' } });

  const closed = openSavedMap(MODULE, FILES, 'files');
  const last = closed.opened.catch((thrown: unknown) => thrown);
  closed.close();
  expect(((await last) as SavedMapError).failure.code).toBe('closed');
});
