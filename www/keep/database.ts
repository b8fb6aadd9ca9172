/** The browser's store of sessions and of the bytes of their meshes. */
import type { DBSchema, IDBPDatabase } from 'idb';
import { openDB } from 'idb';
import type { SessionRecord } from './record.ts';

const NAME = 'conemap';
/** Of the stores, not of the records in them. */
const LAYOUT = 1;

interface Stores extends DBSchema {
  /** By id. */
  sessions: { key: string; value: SessionRecord; indexes: { hashes: string } };
  /** By the hash of the bytes. */
  meshes: { key: string; value: Uint8Array };
}

/** What one writing changes. */
export interface Writing {
  readonly record: SessionRecord;
  /** Bytes of meshes that may not be there, by hash; those that are there are not written again. */
  readonly fresh: ReadonlyMap<string, Uint8Array>;
  /** Hashes of meshes that the session needs no more. */
  readonly dropped: readonly string[];
  /** Another session, which this one continues. */
  readonly absorbed: string | null;
}

/** Everything or nothing: waits for the operations and the end of their transaction. A failure is told once. */
async function whole(
  transaction: { readonly done: Promise<void>; abort(): void },
  operations: () => Promise<void>,
): Promise<void> {
  // An operation that fails ends the transaction, which fails, too.
  transaction.done.catch(() => undefined);
  try {
    await operations();
  } catch (thrown) {
    abort(transaction);
    throw thrown;
  }
  await transaction.done;
}

/** Takes back what a transaction has done; what could not be asked for at all has not ended it yet. */
function abort(transaction: { abort(): void }): void {
  try {
    transaction.abort();
  } catch {
    // It is over already.
  }
}

export class Database {
  readonly #database: IDBPDatabase<Stores>;

  private constructor(database: IDBPDatabase<Stores>) {
    this.#database = database;
  }

  /** Opens the store. Throws where the browser has none or refuses it. `closed` is told when a newer page needs it. */
  static async open(closed: () => void): Promise<Database> {
    const database = await openDB<Stores>(NAME, LAYOUT, {
      upgrade: (fresh) => {
        const sessions = fresh.createObjectStore('sessions', { keyPath: 'id' });
        sessions.createIndex('hashes', 'hashes', { multiEntry: true });
        fresh.createObjectStore('meshes');
      },
      blocking: () => {
        database.close();
        closed();
      },
      terminated: closed,
    });
    return new Database(database);
  }

  /** Writes a session with the meshes that are not there yet. */
  async write({ record, fresh, dropped, absorbed }: Writing): Promise<void> {
    const transaction = this.#database.transaction(['sessions', 'meshes'], 'readwrite');
    const [sessions, meshes] = [transaction.objectStore('sessions'), transaction.objectStore('meshes')];
    if (fresh.size === 0 && dropped.length === 0 && absorbed === null) {
      // Asked for in one go and ended: so it is done even where the page goes at once.
      await whole(transaction, async () => {
        const putting = sessions.put(record);
        transaction.commit();
        await putting;
      });
      return;
    }
    await whole(transaction, async () => {
      for (const [hash, bytes] of fresh) {
        if ((await meshes.getKey(hash)) === undefined) {
          // Of a view on larger memory the browser would keep all.
          await meshes.put(bytes.byteLength === bytes.buffer.byteLength ? bytes : bytes.slice(), hash);
        }
      }
      await sessions.put(record);
      if (absorbed !== null) {
        await sessions.delete(absorbed);
      }
      for (const hash of dropped) {
        if ((await sessions.index('hashes').count(hash)) === 0) {
          await meshes.delete(hash);
        }
      }
    });
  }

  /** A session as it was kept, unchecked; `undefined` where there is none. */
  async session(id: string): Promise<unknown> {
    return this.#database.get('sessions', id);
  }

  /** All sessions as they were kept, unchecked. */
  async sessions(): Promise<readonly unknown[]> {
    return this.#database.getAll('sessions');
  }

  /** The bytes of a mesh; `null` where they are not there. */
  async mesh(hash: string): Promise<Uint8Array | null> {
    const bytes: unknown = await this.#database.get('meshes', hash);
    return bytes instanceof Uint8Array ? bytes : null;
  }

  /** These sessions are not offered again. */
  async decline(ids: readonly string[]): Promise<void> {
    const transaction = this.#database.transaction('sessions', 'readwrite');
    await whole(transaction, async () => {
      for (const id of ids) {
        const record = await transaction.store.get(id);
        if (record !== undefined) {
          await transaction.store.put({ ...record, declined: true });
        }
      }
    });
  }

  /** Removes sessions, and the meshes that no session needs. */
  async remove(ids: readonly string[]): Promise<void> {
    const transaction = this.#database.transaction(['sessions', 'meshes'], 'readwrite');
    const [sessions, meshes] = [transaction.objectStore('sessions'), transaction.objectStore('meshes')];
    await whole(transaction, async () => {
      for (const id of ids) {
        await sessions.delete(id);
      }
      for (const hash of await meshes.getAllKeys()) {
        if ((await sessions.index('hashes').count(hash)) === 0) {
          await meshes.delete(hash);
        }
      }
    });
  }

  close(): void {
    this.#database.close();
  }
}
