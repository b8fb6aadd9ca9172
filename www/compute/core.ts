/** The two wasm modules of the program: the page's module draws meshes; the core, which loads after it, reads meshes and makes maps. */
import type { Failure } from './messages.ts';
import { failureOf } from './messages.ts';

/** The core, loaded or still loading. */
export type Core = WebAssembly.Module | Promise<WebAssembly.Module>;

/** A request as the page makes it: its core may still be loading. */
export type With<Request extends { readonly module: WebAssembly.Module }> = Omit<Request, 'module'> & { readonly module: Core };

async function compiled(url: URL): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`status ${response.status}`);
  }
  if (response.headers.get('content-type') === 'application/wasm') {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Compiles the page's module, for the page and the worker that sorts its files. */
export function compilePage(): Promise<WebAssembly.Module> {
  return compiled(new URL('../wasm/page_bg.wasm', import.meta.url));
}

/** A function that gives the core: its first call fetches the core, and the first call after a failure fetches it again. */
export function coreSource(fetched = (): Promise<WebAssembly.Module> => compiled(new URL('../wasm/core_bg.wasm', import.meta.url))): () => Promise<WebAssembly.Module> {
  let coming: Promise<WebAssembly.Module> | null = null;
  return () => {
    if (coming === null) {
      coming = fetched();
      coming.catch(() => {
        coming = null;
      });
    }
    return coming;
  };
}

/**
 * Posts a request to a worker as soon as the core is loaded. Calls `failed` where that is not possible, but never before this function
 * returns.
 */
export function postWithCore(worker: Pick<Worker, 'postMessage'>, request: { readonly module: Core }, failed: (failure: Failure) => void): void {
  const post = (module: WebAssembly.Module): void => {
    try {
      worker.postMessage({ ...request, module });
    } catch (thrown) {
      queueMicrotask(() => {
        failed(failureOf(thrown));
      });
    }
  };
  if (request.module instanceof Promise) {
    request.module.then(post, (thrown: unknown) => {
      failed({ code: 'no-core', message: failureOf(thrown).message });
    });
  } else {
    post(request.module);
  }
}
