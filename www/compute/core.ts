/** The two modules of the program: one draws meshes, the other, the core, reads them and makes maps, and comes after it. */
import type { Failure } from './messages.ts';
import { failureOf } from './messages.ts';

/** The core, there or on its way. */
export type Core = WebAssembly.Module | Promise<WebAssembly.Module>;

/** A request as the page makes it: the core may be on its way. */
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

/** Compiles the page's module, for the page and its worker of files. */
export function compilePage(): Promise<WebAssembly.Module> {
  return compiled(new URL('../wasm/page_bg.wasm', import.meta.url));
}

/** What gives the core: the first who asks has it fetched, and after a failure the next one has it fetched again. */
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

/** Posts a request to a worker as soon as the core is there; who could not be asked is told, but never at once. */
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
