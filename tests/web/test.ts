/** The tests of the page, in which the page does not warm up the core unless a test asks for it: each would spend two seconds on it. */
import type { BrowserContext } from '@playwright/test';
import { test as usual } from '@playwright/test';

export { expect } from '@playwright/test';

interface Choices {
  /** Whether the page lets the browser optimise the core by making a small map unasked. */
  readonly warmsCore: boolean;
}

export const test = usual.extend<Choices>({
  warmsCore: [false, { option: true }],
  context: async ({ context, warmsCore }, use) => {
    if (!warmsCore) {
      await withoutWarmUp(context);
    }
    await use(context);
  },
});

/** Replaces the worker that warms up the core, on each page of the context, by one that does nothing. */
async function withoutWarmUp(context: BrowserContext): Promise<void> {
  await context.addInitScript(() => {
    globalThis.Worker = new Proxy(Worker, {
      construct: (constructor, [address, options]: ConstructorParameters<typeof Worker>) =>
        String(address).includes('/warmer-')
          ? Object.assign(new EventTarget(), { postMessage: () => undefined, terminate: () => undefined })
          : new constructor(address, options),
    });
  });
}
