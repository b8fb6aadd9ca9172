/** The tests of the page, in which it does not warm the core unless that is asked for: each would pay two seconds for it. */
import type { BrowserContext } from '@playwright/test';
import { test as usual } from '@playwright/test';

export { expect } from '@playwright/test';

interface Choices {
  /** Whether the page lets the browser optimise the core by a small map while nobody has asked for one. */
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

/** Has each page of the context take a worker that does nothing for the one that warms the core. */
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
