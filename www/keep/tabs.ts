/** Which sessions are open in tabs: each tab holds a lock of its session's name until it is closed, however it ends. */

/** The tabs of the page in this browser. */
export interface Tabs {
  /** Makes a session this tab's own; returns `false` where another tab keeps it for `patience` ms. */
  claim(session: string, patience: number): Promise<boolean>;
  /** Releases a session that this tab holds. */
  release(session: string): void;
  /** The sessions that tabs hold, this tab's among them. */
  open(): Promise<ReadonlySet<string>>;
}

const PREFIX = 'conemap-session-';

/** The tabs, seen through the browser's locks. */
export function browserTabs(locks: LockManager): Tabs {
  const releases = new Map<string, () => void>();
  return {
    claim: (session, patience) =>
      new Promise((resolve) => {
        const request = locks.request(PREFIX + session, { signal: AbortSignal.timeout(patience) }, () => {
          resolve(true);
          // The lock is held until this promise is settled, or the tab is closed.
          return new Promise<void>((release) => {
            releases.set(session, release);
          });
        });
        request.catch(() => {
          resolve(false);
        });
      }),
    release: (session) => {
      releases.get(session)?.();
      releases.delete(session);
    },
    open: async () => {
      const { held = [] } = await locks.query();
      const names = held.flatMap(({ name }) => (name?.startsWith(PREFIX) === true ? [name.slice(PREFIX.length)] : []));
      return new Set(names);
    },
  };
}
