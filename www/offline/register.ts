/** Keeps the page for visits without a network, and tells of new builds of it. */
import { TAKE_OVER } from './precache.ts';

/** How often a page that stays open asks for a new build when it is looked at again, in ms. */
const ASKED_EVERY = 3_600_000;

/** The new build takes over, and the page begins anew with it. */
function takeOver(waiting: ServiceWorker): void {
  if (waiting.state !== 'installed') {
    // Another tab was first.
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

/** Calls `isNew` with each build that waits for its turn; on the first visit there is none before it, and nothing to tell. */
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
      // Without a network there is nothing to hear.
      registration.update().catch(() => undefined);
    }
  });
}

/**
 * Keeps the built page in the browser, where it allows that; `isNew` hears of a newer build, with what reloads the page
 * into it. The page that is being developed is not kept.
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
    // A browser that keeps nothing, as in a private window, shows the page all the same.
    console.warn(thrown);
  }
}
