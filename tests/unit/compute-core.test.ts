/** The core is loaded after the page: requests that come earlier wait, and a failure is reported and can be retried. */
import { expect, test, vi } from 'vitest';
import { coreSource, postWithCore } from '../../www/compute/core.ts';

// The content of the module does not matter here.
const CORE = {} as WebAssembly.Module;

test('is fetched once, when it is first asked for', async () => {
  const fetched = vi.fn(() => Promise.resolve(CORE));
  const core = coreSource(fetched);
  expect(fetched).not.toHaveBeenCalled();
  expect(await Promise.all([core(), core()])).toEqual([CORE, CORE]);
  expect(await core()).toBe(CORE);
  expect(fetched).toHaveBeenCalledOnce();
});

test('is fetched again after a failure', async () => {
  const fetched = vi.fn(() => Promise.resolve(CORE)).mockRejectedValueOnce(new Error('status 503'));
  const core = coreSource(fetched);
  await expect(core()).rejects.toThrow('503');
  expect(await core()).toBe(CORE);
});

test('a request is posted at once where the core is there, else when it has come, in the order of the requests', async () => {
  const worker = { postMessage: vi.fn() };
  const failed = vi.fn();
  postWithCore(worker, { module: CORE }, failed);
  expect(worker.postMessage).toHaveBeenCalledExactlyOnceWith({ module: CORE });
  let come: (core: WebAssembly.Module) => void = () => undefined;
  const coming = new Promise<WebAssembly.Module>((resolve) => {
    come = resolve;
  });
  const requests = [1, 2].map((id) => ({ module: coming, id }));
  requests.forEach((request) => {
    postWithCore(worker, request, failed);
  });
  expect(worker.postMessage).toHaveBeenCalledOnce();
  come(CORE);
  await coming;
  expect(worker.postMessage.mock.calls.slice(1)).toEqual([[{ module: CORE, id: 1 }], [{ module: CORE, id: 2 }]]);
  expect(failed).not.toHaveBeenCalled();
});

test('who asked for it hears that it does not come, or that nothing could be posted', async () => {
  const failed = vi.fn();
  postWithCore({ postMessage: vi.fn() }, { module: Promise.reject(new Error('status 404')) }, failed);
  await vi.waitFor(() => {
    expect(failed).toHaveBeenCalledExactlyOnceWith({ code: 'no-core', message: 'status 404' });
  });
  failed.mockClear();
  const unclonable = (): never => {
    throw new DOMException('could not be cloned', 'DataCloneError');
  };
  postWithCore({ postMessage: unclonable }, { module: CORE }, failed);
  expect(failed).not.toHaveBeenCalled();
  await vi.waitFor(() => {
    expect(failed).toHaveBeenCalledExactlyOnceWith(expect.objectContaining({ code: 'unknown', message: 'could not be cloned' }));
  });
});
