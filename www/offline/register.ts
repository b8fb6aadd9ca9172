/** Keeps the page in the browser for visits without a network, and reports new builds of it. */
import { TAKE_OVER } from './precache.ts';

/** The least time between two checks for a new build, in ms; a page that stays open checks when the user comes back to it. */
const ASKED_EVERY = 3_600_000;

/** Lets the new build take over, and reloads the page with it. */
function takeOver(waiting: ServiceWorker): void {
  if (waiting.state !== 'installed') {
    // Another tab has already let the new build take over.
    location.reload();
    return;
  }
  navigator.serviceWorker.addEventListener(
    'controllerchange',
    () => {
      location.reload();
    },
    { once: true },
  );
  waiting.postMessage(TAKE_OVER);
}

/** Calls `isNew` with each build that waits to take over. On the first visit there is no older build, and so nothing to report. */
function watch(registration: ServiceWorkerRegistration, isNew: (waiting: ServiceWorker) => void): void {
  const told = (candidate: ServiceWorker | null): void => {
    if (candidate?.state === 'installed' && navigator.serviceWorker.controller !== null) {
      isNew(candidate);
    }
  };
  told(registration.waiting);
  registration.addEventListener('updatefound', () => {
    const { installing } = registration;
    installing?.addEventListener('statechange', () => {
      told(installing);
    });
  });
}

function askAgain(registration: ServiceWorkerRegistration): void {
  let last = Date.now();
  document.addEventListener('visibilitychange', () => {
    if (document.visibilityState === 'visible' && Date.now() - last > ASKED_EVERY) {
      last = Date.now();
      // Without a network the check fails, which does not matter.
      registration.update().catch(() => undefined);
    }
  });
}

/**
 * Keeps the built page in the browser, where that is allowed. `isNew` is called when there is a newer build, with a function that reloads
 * the page into it. A page in development is not kept.
 */
export async function keepOffline(isNew: (reload: () => void) => void): Promise<void> {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) {
    return;
  }
  try {
    const registration = await navigator.serviceWorker.register('./service-worker.js');
    watch(registration, (waiting) => {
      isNew(() => {
        takeOver(waiting);
      });
    });
    askAgain(registration);
  } catch (thrown) {
    // A browser that keeps nothing, as in a private window, can still show the page.
    console.warn(thrown);
  }
}
