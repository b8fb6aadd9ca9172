/** The browser's store of sessions and of the bytes of their meshes. */
import type { DBSchema, IDBPDatabase } from 'idb';
import { openDB } from 'idb';
import type { SessionRecord } from './record.ts';

const NAME = 'conemap';
/** The version of the database's layout, not of the records in it. */
const LAYOUT = 1;

interface Stores extends DBSchema {
  /** Sessions by id. */
  sessions: { key: string; value: SessionRecord; indexes: { hashes: string } };
  /** The bytes of meshes by their hash. */
  meshes: { key: string; value: Uint8Array };
}

/** The changes of one transaction. */
export interface Writing {
  readonly record: SessionRecord;
  /** Bytes, by hash, of meshes that may not be in the store; those that are there are not written again. */
  readonly fresh: ReadonlyMap<string, Uint8Array>;
  /** Hashes of meshes that the session no longer needs. */
  readonly dropped: readonly string[];
  /** The id of another session, which this one continues and replaces. */
  readonly absorbed: string | null;
}

/** Does everything or nothing: waits for the operations and the end of their transaction. A failure is thrown once. */
async function whole(
  transaction: { readonly done: Promise<void>; abort(): void },
  operations: () => Promise<void>,
): Promise<void> {
  // An operation that fails also makes its transaction fail.
  transaction.done.catch(() => undefined);
  try {
    await operations();
  } catch (thrown) {
    abort(transaction);
    throw thrown;
  }
  await transaction.done;
}

/** Aborts a transaction; one whose first operation could not even be requested is still open. */
function abort(transaction: { abort(): void }): void {
  try {
    transaction.abort();
  } catch {
    // The transaction is over already.
  }
}

export class Database {
  readonly #database: IDBPDatabase<Stores>;

  private constructor(database: IDBPDatabase<Stores>) {
    this.#database = database;
  }

  /** Opens the store. Throws where the browser has none or refuses it. `closed` is called when a newer page needs the store. */
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
      // The request and the commit are made at once, so that the record is written even where the page closes now.
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
          // For a view of a larger buffer the browser would store the whole buffer.
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

  /** Marks sessions as declined, so that they are not offered again. */
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

  /** Removes sessions, and the meshes that no other session needs. */
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
