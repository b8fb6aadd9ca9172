/**
 * Keeps the work in the browser's store as it changes, and brings it back: at once after a reload, and when the user asks for it on a new
 * visit.
 */
import type { NamedBytes } from '../files.ts';
import { areMarksGood, FileRefused, meshFile } from '../files.ts';
import type { Choice } from '../keep/choice.ts';
import { choiceOf } from '../keep/choice.ts';
import { Database } from '../keep/database.ts';
import type { MeshRecord, SessionRecord } from '../keep/record.ts';
import { keptOf, meshesOf, meshKey, readSession, recordOf, workFrom } from '../keep/record.ts';
import type { Tabs } from '../keep/tabs.ts';
import { browserTabs } from '../keep/tabs.ts';
import { SENTENCES } from '../messages.ts';
import type { FileReader } from '../reading/reader.ts';
import { readMesh } from '../reading/reader.ts';
import { hashOf } from '../send/hash.ts';
import { heldMeshes, NO_HISTORY } from '../store/history.ts';
import { ALL_ALLOWED } from '../store/refused.ts';
import { isMapless, shownResult } from '../store/staleness.ts';
import type { MeshFile, Offer, State } from '../store/state.ts';
import type { Store } from '../store/store.ts';
import { isSameWork } from '../store/work.ts';
import { isNotThere, perform } from './task.ts';

/** What the keeper needs of the browser and the core. */
export interface Surroundings {
  /** Opens the store; calls `closed` when the store can no longer be used. */
  open(closed: () => void): Promise<Database>;
  /** The tabs of the page. Throws where the browser has no locks. */
  readonly tabs: () => Tabs;
  /** What this tab remembers over a reload. */
  readonly memory: () => Pick<Storage, 'getItem' | 'setItem'>;
  readonly newId: () => string;
  /** The present time in ms since 1970. */
  readonly now: () => number;
  /** The hash of bytes; `null` where the browser computes none. */
  readonly hash: (bytes: Uint8Array<ArrayBuffer>) => Promise<string | null>;
  /**
   * Reads and checks a mesh. The function that it returns takes the mesh into the page's memory, and throws `FileRefused` where it was
   * refused.
   */
  readonly read: (file: NamedBytes, signal: AbortSignal) => Promise<() => MeshFile>;
  /** How long changes are gathered before they are written, in ms. */
  readonly delay: number;
}

/** The browser that the page is in. */
export function browserWith(reader: FileReader): Surroundings {
  return {
    open: (closed) => Database.open(closed),
    tabs: () => browserTabs(navigator.locks),
    memory: () => sessionStorage,
    newId: () => crypto.randomUUID(),
    now: () => Date.now(),
    hash: hashOf,
    read: async (file, signal) => {
      const reading = await readMesh(reader, file, ALL_ALLOWED, signal);
      if (reading.kind === 'bad' && isNotThere(reading.failure)) {
        throw new FileRefused(reading.sentence, reading);
      }
      return () => meshFile({ file, reading });
    },
    delay: 400,
  };
}

/** What was kept for this tab, and what can be offered. */
export interface Found {
  readonly own: SessionRecord | null;
  readonly offer: Offer | null;
  /** A sentence about kept work that cannot be read. */
  readonly note: string | null;
}

const NOTHING: Found = { own: null, offer: null, note: null };
/** The key under which a tab remembers its session. */
const MEMORY_KEY = 'conemap-session';
/**
 * How long to wait for a lock, in ms: a page that was just reloaded may still hold it for a moment, while a copied tab keeps holding it.
 */
const PATIENCE = 500;

/** How long to wait for the store to open, in ms: some browsers never open it. */
const LONGEST_OPENING = 3000;

/** The result of a promise. Throws where it takes longer than `milliseconds`. */
function within<T>(milliseconds: number, promised: Promise<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => {
      reject(new Error(`no answer in ${milliseconds} ms`));
    }, milliseconds);
    promised.then(resolve, reject).finally(() => {
      clearTimeout(timer);
    });
  });
}

/** Whether the work has a map that goes with the page, or had one before it was brought back. A run that goes on is none yet. */
function hadMap(state: State): boolean {
  return isMapless(state) || shownResult(state) !== null;
}

/** Whether two states agree in everything that is kept. */
function isKept(state: State, previous: State): boolean {
  const [ui, before] = [state.ui, previous.ui];
  return (
    isSameWork(state, previous) &&
    hadMap(state) === hadMap(previous) &&
    state.up === previous.up &&
    state.history === previous.history &&
    ui.step === before.step &&
    ui.panel === before.panel &&
    ui.link === before.link &&
    ui.cameras === before.cameras &&
    ui.style === before.style
  );
}

function offerOf(record: SessionRecord | null): Offer | null {
  if (record === null) {
    return null;
  }
  const { id, work, saved } = record;
  const [source, target] = work.meshes;
  return { session: id, names: [source?.name ?? null, target?.name ?? null], pairs: work.pairs.length, saved };
}

function noteOf({ hasOthers, hasBroken }: Choice): string | null {
  return hasOthers ? SENTENCES.keptByOther : hasBroken ? SENTENCES.keptUnreadable : null;
}

export class Keeper {
  readonly #store: Store;
  readonly #around: Surroundings;
  readonly #hashes = new WeakMap<Uint8Array, Promise<string | null>>();
  #database: Database | null = null;
  #tabs: Tabs | null = null;
  #id = '';
  /** Hashes of the meshes of the session as it was last written; `null` before the first writing. */
  #written: ReadonlySet<string> | null = null;
  /** Sessions of earlier visits that could be offered when the page was opened. */
  #offerable: readonly string[] = [];
  /** The earlier session that this one continues, until this one is written. */
  #absorbed: string | null = null;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #writing: Promise<void> = Promise.resolve();
  #said = false;

  constructor(store: Store, around: Surroundings) {
    this.#store = store;
    this.#around = around;
  }

  /**
   * Finds the kept work. `linked` is the demo that the address names: a tab whose address names another demo than its session has begins a
   * new session, and the earlier one can be offered.
   */
  async find(linked: string | null): Promise<Found> {
    try {
      const opening = this.#around.open(() => {
        this.#close(SENTENCES.keepsNoMore);
      });
      this.#database = await within(LONGEST_OPENING, opening);
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

  /** Brings back this tab's work, and offers what can be continued; returns whether this tab's work is on the page now. */
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
    const isThere = await this.#restore(own);
    if (isThere && own.id !== this.#id) {
      await this.#quietly(() => this.#continueWith(own.id));
    }
    if (!isThere && this.#tabs !== null) {
      // The kept session could not be shown, so what comes onto the page instead must not be written over it.
      const tabs = this.#tabs;
      await this.#quietly(() => this.#begin(tabs));
    }
    return isThere;
  }

  /** Brings the offered work onto the page; this tab's session continues it. */
  async accept(): Promise<void> {
    const { state, dispatch } = this.#store;
    if (state.offer === null || this.#database === null) {
      return;
    }
    if (state.job.kind === 'running') {
      dispatch({ kind: 'error', sentence: SENTENCES.whileRunning });
      return;
    }
    const id = state.offer.session;
    dispatch({ kind: 'offer-closed' });
    const reading = readSession(await this.#database.session(id).catch(() => undefined));
    if (reading.kind !== 'session') {
      dispatch({ kind: 'error', sentence: SENTENCES.keptUnreadable });
    } else if (await this.#restore(reading.record)) {
      await this.#continueWith(id);
    }
  }

  /**
   * Marks the offered session and all older ones as declined, so that none is offered again; the offer stays on the page until that is
   * written.
   */
  async decline(): Promise<void> {
    const { offer } = this.#store.state;
    if (offer !== null) {
      const open = (await this.#tabs?.open()) ?? new Set<string>();
      const closed = this.#offerable.filter((id) => !open.has(id));
      await this.#quietly((database) => database.decline(closed));
    }
    if (this.#store.state.offer === offer) {
      this.#store.dispatch({ kind: 'offer-closed' });
    }
  }

  /** Writes waiting changes at once, since the page may be about to close. The promise is settled when they are written. */
  flush(): Promise<void> {
    if (this.#timer !== null) {
      clearTimeout(this.#timer);
      this.#timer = null;
      this.#writing = this.#writing.then(() => this.#write());
    }
    return this.#writing;
  }

  /** Chooses among all kept sessions this tab's own and the one to offer. */
  async #look(database: Database, tabs: Tabs, linked: string | null): Promise<Found> {
    const before = this.#around.memory().getItem(MEMORY_KEY);
    const isMine = before !== null && (await tabs.claim(before, PATIENCE));
    const reading = before === null ? null : readSession(await database.session(before));
    const record = reading?.kind === 'session' ? reading.record : null;
    const own = linked === null || linked === record?.work.demo ? record : null;
    if (isMine && own !== null) {
      this.#id = before;
    } else {
      // A copied tab continues with a copy of the session. A tab that opens other work leaves its earlier session free.
      if (isMine) {
        tabs.release(before);
      }
      await this.#begin(tabs);
    }
    const open = new Set(await tabs.open());
    if (isMine && before !== this.#id) {
      // The browser may need a moment to see that the lock is free.
      open.delete(before);
    }
    if (own !== null) {
      // A page that was reloaded may release its lock late, after this tab has begun another session; the work that comes onto this page
      // must not be offered as well.
      open.add(own.id);
    }
    const choice = choiceOf(await database.sessions(), open);
    this.#offerable = choice.offerable;
    await database.remove(choice.obsolete);
    return { own, offer: offerOf(choice.latest), note: noteOf(choice) };
  }

  /** Gives this tab a session of its own, of which nothing is written yet. */
  async #begin(tabs: Tabs): Promise<void> {
    this.#id = this.#around.newId();
    this.#written = null;
    await tabs.claim(this.#id, PATIENCE);
    this.#around.memory().setItem(MEMORY_KEY, this.#id);
  }

  /**
   * Lets this tab's session go on with the work of another session, which is on the page now; the other one is removed unless a tab has it
   * open.
   */
  async #continueWith(id: string): Promise<void> {
    const isOpen = (await this.#tabs?.open())?.has(id) ?? false;
    this.#absorbed = isOpen ? null : id;
    this.#schedule();
  }

  /** Puts a session's work onto the page; returns `false` where that fails, and shows a sentence where the work cannot be read. */
  async #restore(record: SessionRecord): Promise<boolean> {
    const outcome = await perform(
      this.#store,
      SENTENCES.bringingBack,
      (signal) => this.#read(meshesOf(record), signal),
      (read) => {
        const files = this.#taken(read);
        try {
          const { work, history } = workFrom(record, files, this.#store.state.demos);
          if (!areMarksGood(work)) {
            throw new FileRefused(SENTENCES.keptUnreadable);
          }
          const areStepsGood = [...history.past, ...history.future].every((step) => areMarksGood(step.work));
          const steps = areStepsGood ? history : NO_HISTORY;
          this.#store.dispatch({ kind: 'restored', work, ui: record.ui, history: steps, hadMap: record.hadMap === true });
        } finally {
          this.#freeUnused(files);
        }
      },
    );
    if (outcome === 'failed') {
      await this.#quietly((database) => database.decline([record.id]));
    }
    return outcome === 'done';
  }

  /** The meshes by key. They are read, but not yet in the page's memory. */
  async #read(meshes: readonly MeshRecord[], signal: AbortSignal): Promise<ReadonlyMap<string, () => MeshFile>> {
    const read = await Promise.all(
      meshes.map(async (mesh): Promise<readonly [string, () => MeshFile]> => {
        const bytes = (await this.#database?.mesh(mesh.hash)) ?? null;
        if (bytes === null) {
          throw new FileRefused(SENTENCES.keptUnreadable);
        }
        const { name, address, ofDemo, picture: hash } = mesh;
        // A mesh whose picture is missing is shown without it.
        const picture = hash === undefined ? null : ((await this.#database?.mesh(hash)) ?? null);
        const file = {
          name,
          bytes,
          ...(address === undefined ? {} : { address }),
          ...(ofDemo === undefined ? {} : { ofDemo }),
          ...(picture === null ? {} : { picture }),
        };
        return [meshKey(mesh), await this.#around.read(file, signal)];
      }),
    );
    return new Map(read);
  }

  /** Takes the meshes into the page's memory, by key: all of them or none. */
  #taken(read: ReadonlyMap<string, () => MeshFile>): ReadonlyMap<string, MeshFile> {
    const files = new Map<string, MeshFile>();
    try {
      for (const [key, take] of read) {
        files.set(key, take());
      }
      return files;
    } catch (thrown) {
      files.forEach((file) => {
        file.mesh.free();
      });
      throw thrown;
    }
  }

  /** Frees the meshes that came neither onto the page nor into its history. */
  #freeUnused(files: ReadonlyMap<string, MeshFile>): void {
    const held = heldMeshes(this.#store.state.history, this.#store.state);
    for (const file of files.values()) {
      if (!held.has(file)) {
        file.mesh.free();
      }
    }
  }

  #follow(state: State, previous: State): void {
    if (!this.#isMade(state) || isKept(state, previous)) {
      return;
    }
    this.#schedule();
    // Writing a mesh takes long, so that it is not done before the page has closed unless it begins now. A demo can wait: where it came by
    // itself, it will not be written at all.
    if (state.meshes !== previous.meshes && state.demo === null) {
      void this.flush();
    }
  }

  /**
   * Whether the user has made something. A page that only shows a demo is not written, since it would push out work that the user made
   * before.
   */
  #isMade({ history }: State): boolean {
    return this.#written !== null || this.#absorbed !== null || history.past.length + history.future.length > 0;
  }

  #schedule(): void {
    if (this.#database !== null && this.#timer === null) {
      this.#timer = setTimeout(() => {
        void this.flush();
      }, this.#around.delay);
    }
  }

  async #hashOf(bytes: Uint8Array): Promise<string> {
    const known = this.#hashes.get(bytes);
    // The bytes lie in the page's own memory, never in a buffer that threads share.
    const hash = known ?? this.#around.hash(bytes as Uint8Array<ArrayBuffer>);
    this.#hashes.set(bytes, hash);
    const value = await hash;
    if (value === null) {
      throw new Error('no hash of a mesh');
    }
    return value;
  }

  async #write(): Promise<void> {
    const { state } = this.#store;
    if (this.#database === null || !this.#isMade(state)) {
      return;
    }
    try {
      const kept = keptOf(state);
      const hashes = new Map<Uint8Array, string>();
      for (const { bytes, picture } of kept.files) {
        for (const part of picture === undefined ? [bytes] : [bytes, picture]) {
          hashes.set(part, await this.#hashOf(part));
        }
      }
      const record = recordOf(kept, { id: this.#id, saved: this.#around.now(), ui: state.ui, hadMap: hadMap(state) }, hashes);
      const needed = new Set(record.hashes);
      const fresh = new Map([...hashes].flatMap(([bytes, hash]) => (this.#written?.has(hash) === true ? [] : [[hash, bytes]])));
      const dropped = [...(this.#written ?? [])].filter((hash) => !needed.has(hash));
      await this.#database.write({ record, fresh, dropped, absorbed: this.#absorbed });
      this.#written = needed;
      this.#absorbed = null;
      this.#said = false;
    } catch (thrown) {
      console.warn(thrown);
      const isFull = thrown instanceof DOMException && thrown.name === 'QuotaExceededError';
      this.#say(isFull ? SENTENCES.noRoom : SENTENCES.keepsNoMore);
    }
  }

  /** Does something with the store whose failure the user need not hear of. */
  async #quietly(action: (database: Database) => Promise<void>): Promise<void> {
    try {
      if (this.#database !== null) {
        await action(this.#database);
      }
    } catch (thrown) {
      console.warn(thrown);
    }
  }

  /** Gives the store up and says so. */
  #close(sentence: string): void {
    this.#database = null;
    this.#say(sentence);
  }

  /** Shows a sentence that nothing is kept, once until something is kept again. */
  #say(sentence: string): void {
    if (!this.#said) {
      this.#said = true;
      this.#store.dispatch({ kind: 'toast', sentence, undo: false });
    }
  }
}
