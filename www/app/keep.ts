/** Keeps the work in the browser as it changes, and brings it back: after a reload at once, on a new visit when asked for. */
import * as v from 'valibot';
import type { NamedBytes } from '../files.ts';
import { areMarksGood, FileRefused, meshFile } from '../files.ts';
import { Database } from '../keep/database.ts';
import type { MeshRecord, SessionRecord } from '../keep/record.ts';
import { keptOf, meshesOf, meshKey, readSession, recordOf, workFrom } from '../keep/record.ts';
import type { Tabs } from '../keep/tabs.ts';
import { browserTabs } from '../keep/tabs.ts';
import { SENTENCES } from '../messages.ts';
import { hashOf } from '../send/hash.ts';
import { heldMeshes, NO_HISTORY } from '../store/history.ts';
import type { MeshFile, Offer, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { isSameWork } from '../store/work.ts';
import { perform } from './task.ts';

/** What the keeper needs of the browser and the core. */
export interface Surroundings {
  /** Opens the store; `closed` is told when it can be used no more. */
  open(closed: () => void): Promise<Database>;
  /** Throws where the browser has no locks. */
  readonly tabs: () => Tabs;
  /** What this tab remembers over a reload. */
  readonly memory: () => Pick<Storage, 'getItem' | 'setItem'>;
  readonly newId: () => string;
  /** In ms since 1970. */
  readonly now: () => number;
  /** The hash of bytes; `null` where the browser gives none. */
  readonly hash: (bytes: Uint8Array<ArrayBuffer>) => Promise<string | null>;
  /** Reads and checks a mesh. Throws `FileRefused`. */
  readonly read: (file: NamedBytes) => MeshFile;
  /** How long changes are gathered before they are written, in ms. */
  readonly delay: number;
}

/** The browser that the page is in. */
export const BROWSER: Surroundings = {
  open: (closed) => Database.open(closed),
  tabs: () => browserTabs(navigator.locks),
  memory: () => sessionStorage,
  newId: () => crypto.randomUUID(),
  now: () => Date.now(),
  hash: hashOf,
  read: meshFile,
  delay: 400,
};

/** What was kept for this tab, and what can be offered. */
export interface Found {
  readonly own: SessionRecord | null;
  readonly offer: Offer | null;
  /** A sentence about what cannot be read. */
  readonly note: string | null;
}

const NOTHING: Found = { own: null, offer: null, note: null };
/** Where a tab remembers its session. */
const MEMORY_KEY = 'conemap-session';
/** Sessions that are kept beside those that tabs have open. */
const MOST_SESSIONS = 5;
/** How long a lock is waited for, in ms: a page that was just reloaded may still hold it; a tab that was copied holds it on. */
const PATIENCE = 500;

/** What can be said of any record, of whatever version. */
const Outline = v.object({ id: v.string(), saved: v.fallback(v.number(), 0) });

/** Whether nothing that is kept has changed. */
function isKept(state: State, previous: State): boolean {
  const [ui, before] = [state.ui, previous.ui];
  return (
    isSameWork(state, previous) &&
    state.up === previous.up &&
    state.history === previous.history &&
    ui.step === before.step &&
    ui.panel === before.panel &&
    ui.link === before.link &&
    ui.cameras === before.cameras &&
    ui.style === before.style
  );
}

export class Keeper {
  readonly #store: Store;
  readonly #around: Surroundings;
  readonly #hashes = new WeakMap<MeshFile, Promise<string | null>>();
  #database: Database | null = null;
  #tabs: Tabs | null = null;
  #id = '';
  /** Hashes of the meshes of what is written; `null` before anything is. */
  #written: ReadonlySet<string> | null = null;
  /** The session that this one continues, until that is written. */
  #absorbed: string | null = null;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #writing: Promise<void> = Promise.resolve();
  #said = false;

  constructor(store: Store, around: Surroundings) {
    this.#store = store;
    this.#around = around;
  }

  /**
   * Finds what was kept. `linked` is the demo that the address names: a tab that comes to another one than it had begins a
   * session of its own, and leaves the earlier one to be offered.
   */
  async find(linked: string | null): Promise<Found> {
    try {
      this.#database = await this.#around.open(() => {
        this.#close(SENTENCES.keepsNoMore);
      });
      this.#tabs = this.#around.tabs();
      const found = await this.#look(this.#database, this.#tabs, linked);
      this.#store.subscribe((state, previous) => {
        this.#follow(state, previous);
      });
      return found;
    } catch (thrown) {
      console.warn(thrown);
      this.#database = null;
      return { ...NOTHING, note: SENTENCES.keepsNothing };
    }
  }

  /** Brings back what this tab had, and shows what can be continued; whether this tab's work is on the page now. */
  async resume({ own, offer, note }: Found): Promise<boolean> {
    const { dispatch } = this.#store;
    if (offer !== null) {
      dispatch({ kind: 'offered', offer });
    }
    if (note !== null) {
      dispatch({ kind: 'toast', sentence: note, undo: false });
    }
    if (own === null) {
      return false;
    }
    this.#written = own.id === this.#id ? new Set(own.hashes) : null;
    return this.#restore(own);
  }

  /** Brings the offered work onto the page; this tab's session continues it. */
  async accept(): Promise<void> {
    const { state, dispatch } = this.#store;
    if (state.offer === null || this.#database === null) {
      return;
    }
    const id = state.offer.session;
    dispatch({ kind: 'offer-closed' });
    const reading = readSession(await this.#database.session(id).catch(() => undefined));
    if (reading.kind !== 'session') {
      dispatch({ kind: 'error', sentence: SENTENCES.keptUnreadable });
    } else if (await this.#restore(reading.record)) {
      const isOpen = (await this.#tabs?.open())?.has(id) ?? false;
      this.#absorbed = isOpen ? null : id;
      this.#schedule();
    }
  }

  /** The offered work is not asked about again. */
  async decline(): Promise<void> {
    const { offer } = this.#store.state;
    this.#store.dispatch({ kind: 'offer-closed' });
    if (offer !== null) {
      await this.#database?.decline(offer.session).catch((thrown: unknown) => {
        console.warn(thrown);
      });
    }
  }

  /** Writes what waits at once: the page may be about to go. Settled when it is written. */
  flush(): Promise<void> {
    if (this.#timer !== null) {
      clearTimeout(this.#timer);
      this.#timer = null;
      this.#writing = this.#writing.then(() => this.#write());
    }
    return this.#writing;
  }

  /** This tab's session and the one to offer, out of all. */
  async #look(database: Database, tabs: Tabs, linked: string | null): Promise<Found> {
    const memory = this.#around.memory();
    const before = memory.getItem(MEMORY_KEY);
    const isMine = before !== null && (await tabs.claim(before, PATIENCE));
    const reading = before === null ? null : readSession(await database.session(before));
    const record = reading?.kind === 'session' ? reading.record : null;
    const isLinkedElsewhere = linked !== null && record !== null && linked !== record.work.demo;
    const own = isLinkedElsewhere ? null : record;
    if (before !== null && isMine && own !== null) {
      this.#id = before;
    } else {
      // A copied tab continues with a copy.
      if (before !== null && isMine) {
        tabs.release(before);
      }
      this.#id = this.#around.newId();
      await tabs.claim(this.#id, PATIENCE);
      memory.setItem(MEMORY_KEY, this.#id);
    }
    const open = await tabs.open();
    const all = await database.sessions();
    await this.#tidy(database, all, open);
    return { own, ...this.#offerOf(all, open, isLinkedElsewhere ? before : null) };
  }

  /** The latest session that no tab has; `left` is one that this tab had until now. */
  #offerOf(all: readonly unknown[], open: ReadonlySet<string>, left: string | null): Pick<Found, 'offer' | 'note'> {
    const closed = all.filter((value) => {
      const id = v.is(Outline, value) ? v.parse(Outline, value).id : null;
      return id !== this.#id && (id === left || id === null || !open.has(id));
    });
    const readings = closed.map(readSession);
    const records = readings.flatMap((reading) => (reading.kind === 'session' ? [reading.record] : []));
    const latest = records.filter(({ declined }) => !declined).reduce<SessionRecord | null>(
      (best, record) => (best === null || record.saved > best.saved ? record : best),
      null,
    );
    const isOther = readings.some(({ kind }) => kind === 'other-version');
    const isBroken = readings.some(({ kind }) => kind === 'broken');
    const note = isOther ? SENTENCES.keptByOther : isBroken ? SENTENCES.keptUnreadable : null;
    if (latest === null) {
      return { offer: null, note };
    }
    const [source, target] = latest.work.meshes;
    const names = [source?.name ?? null, target?.name ?? null] as const;
    return { offer: { session: latest.id, names, pairs: latest.work.pairs.length, saved: latest.saved }, note };
  }

  /** Removes what cannot be read, all but the latest sessions, and the meshes of neither. */
  async #tidy(database: Database, all: readonly unknown[], open: ReadonlySet<string>): Promise<void> {
    const outlines = all.flatMap((value) => {
      const outline = v.safeParse(Outline, value);
      return outline.success ? [{ ...outline.output, isBroken: readSession(value).kind === 'broken' }] : [];
    });
    const closed = outlines.filter(({ id }) => id !== this.#id && !open.has(id));
    const latest = closed.filter(({ isBroken }) => !isBroken).sort((a, b) => b.saved - a.saved);
    const kept = new Set(latest.slice(0, MOST_SESSIONS).map(({ id }) => id));
    await database.remove(closed.filter(({ id }) => !kept.has(id)).map(({ id }) => id));
  }

  /** Puts a session's work onto the page; `false` where it does not come, and says why where it cannot be read. */
  async #restore(record: SessionRecord): Promise<boolean> {
    const outcome = await perform(
      this.#store,
      SENTENCES.bringingBack,
      () => this.#bytesOf(meshesOf(record)),
      (named) => {
        const files = this.#read(named);
        try {
          const { work, history } = workFrom(record, files, this.#store.state.demos);
          if (!areMarksGood(work)) {
            throw new FileRefused(SENTENCES.keptUnreadable);
          }
          const areStepsGood = [...history.past, ...history.future].every((step) => areMarksGood(step.work));
          this.#store.dispatch({ kind: 'restored', work, ui: record.ui, history: areStepsGood ? history : NO_HISTORY });
        } finally {
          this.#freeUnused(files);
        }
      },
    );
    if (outcome === 'failed') {
      await this.#setAside(record.id);
    }
    return outcome === 'done';
  }

  /** A session that cannot be brought back stays for a while, but is neither written over nor offered again. */
  async #setAside(id: string): Promise<void> {
    try {
      await this.#database?.decline(id);
      if (id === this.#id) {
        this.#id = this.#around.newId();
        this.#written = null;
        await this.#tabs?.claim(this.#id, PATIENCE);
        this.#around.memory().setItem(MEMORY_KEY, this.#id);
      }
    } catch (thrown) {
      console.warn(thrown);
    }
  }

  async #bytesOf(meshes: readonly MeshRecord[]): Promise<ReadonlyMap<string, NamedBytes>> {
    const named = await Promise.all(
      meshes.map(async (mesh): Promise<readonly [string, NamedBytes]> => {
        const bytes = (await this.#database?.mesh(mesh.hash)) ?? null;
        if (bytes === null) {
          throw new FileRefused(SENTENCES.keptUnreadable);
        }
        const { name, address } = mesh;
        return [meshKey(mesh), { name, bytes, ...(address === undefined ? {} : { address }) }];
      }),
    );
    return new Map(named);
  }

  /** The meshes by key; all or none. */
  #read(named: ReadonlyMap<string, NamedBytes>): ReadonlyMap<string, MeshFile> {
    const files = new Map<string, MeshFile>();
    try {
      for (const [key, file] of named) {
        files.set(key, this.#around.read(file));
      }
      return files;
    } catch (thrown) {
      files.forEach((file) => {
        file.mesh.free();
      });
      throw thrown;
    }
  }

  /** Gives back the meshes that did not come onto the page or into its history. */
  #freeUnused(files: ReadonlyMap<string, MeshFile>): void {
    const held = heldMeshes(this.#store.state.history, this.#store.state);
    for (const file of files.values()) {
      if (!held.has(file)) {
        file.mesh.free();
      }
    }
  }

  /** A page that nobody changed is not kept: it would push out what somebody made. */
  #follow(state: State, previous: State): void {
    const isMade = this.#written !== null || state.history.past.length + state.history.future.length > 0;
    if (isMade && !isKept(state, previous)) {
      this.#schedule();
    }
  }

  #schedule(): void {
    if (this.#database !== null && this.#timer === null) {
      this.#timer = setTimeout(() => {
        void this.flush();
      }, this.#around.delay);
    }
  }

  async #hashOf(file: MeshFile): Promise<string> {
    const known = this.#hashes.get(file);
    // What the page holds lies in its own memory, and is no buffer that threads share.
    const hash = known ?? this.#around.hash(file.bytes as Uint8Array<ArrayBuffer>);
    this.#hashes.set(file, hash);
    const value = await hash;
    if (value === null) {
      throw new Error('no hash of a mesh');
    }
    return value;
  }

  async #write(): Promise<void> {
    if (this.#database === null) {
      return;
    }
    const { state } = this.#store;
    try {
      const kept = keptOf(state);
      const hashes = new Map<MeshFile, string>();
      for (const file of kept.files) {
        hashes.set(file, await this.#hashOf(file));
      }
      const record = recordOf(kept, { id: this.#id, saved: this.#around.now(), ui: state.ui }, hashes);
      const needed = new Set(record.hashes);
      const fresh = new Map([...hashes].map(([file, hash]) => [hash, file.bytes] as const).filter(([hash]) => this.#written?.has(hash) !== true));
      const dropped = [...(this.#written ?? [])].filter((hash) => !needed.has(hash));
      await this.#database.write({ record, fresh, dropped, absorbed: this.#absorbed });
      this.#written = needed;
      this.#absorbed = null;
    } catch (thrown) {
      console.warn(thrown);
      const isFull = thrown instanceof DOMException && thrown.name === 'QuotaExceededError';
      this.#say(isFull ? SENTENCES.noRoom : SENTENCES.keepsNoMore);
    }
  }

  /** The store cannot be used any more. */
  #close(sentence: string): void {
    this.#database = null;
    this.#say(sentence);
  }

  /** Says once that nothing is kept. */
  #say(sentence: string): void {
    if (!this.#said) {
      this.#said = true;
      this.#store.dispatch({ kind: 'toast', sentence, undo: false });
    }
  }
}
