/** The work that is kept in the browser: reloads, new visits, several tabs, and stores that fail. */
import { IDBFactory } from 'fake-indexeddb';
import 'fake-indexeddb/auto';
import { openDB } from 'idb';
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import type { Found, Surroundings } from '../../www/app/keep.ts';
import { Keeper } from '../../www/app/keep.ts';
import { Database } from '../../www/keep/database.ts';
import type { SessionRecord } from '../../www/keep/record.ts';
import { keptOf, readSession, recordOf } from '../../www/keep/record.ts';
import type { Tabs } from '../../www/keep/tabs.ts';
import { FileRefused } from '../../www/named-file.ts';
import type { Event } from '../../www/store/events.ts';
import type { MeshFile, State } from '../../www/store/state.ts';
import { isMapless } from '../../www/store/staleness.ts';
import { Store } from '../../www/store/store.ts';
import { workOf } from '../../www/store/work.ts';
import { DEMO, mesh, OUTPUT, READY, REPORT } from './fixtures.ts';

/** A core that accepts every vertex up to 1000. */
vi.mock('../../www/wasm/page.js', () => ({
  checkLandmarks: (_: unknown, __: number, bytes: Uint8Array) => {
    const { pairs } = JSON.parse(new TextDecoder().decode(bytes)) as { pairs: unknown[][] };
    if (pairs.flat().some((point) => typeof point === 'number' && point > 1000)) {
      throw new Error('no such vertex');
    }
  },
}));

/** A delay longer than any test, so that the work is written only when a test asks for it. */
const DELAY = 60_000;
const CAT_AND_LION: readonly Event[] = [
  { kind: 'mesh', side: 0, file: mesh('cat.off') },
  { kind: 'mesh', side: 1, file: mesh('lion.off') },
  { kind: 'landmarks', file: { pairs: [[0, 10], [1, 11], [2, 12], [3, 13]], labels: ['nose', '', '', ''] } },
];
const pick = (point: number): Event => ({ kind: 'point-picked', side: 0, point });

/** The locks that the tabs of one browser share. */
let locks: Map<string, Tab>;
/** All tabs of a test. */
let tabs: Tab[];
let ids: number;
let clock: number;
let database: Database;

/** A tab, from its opening to its end. */
class Tab {
  readonly store = new Store();
  readonly keeper: Keeper;
  readonly made: (MeshFile & { readonly freed: () => number })[] = [];
  readonly memory: Map<string, string>;
  found: Found = { own: null, offer: null, note: null };
  isResumed = false;

  /** `memory` is what the browser returns to a tab after a reload. */
  constructor(memory = new Map<string, string>(), around: Partial<Surroundings> = {}) {
    tabs.push(this);
    this.memory = memory;
    this.keeper = new Keeper(this.store, {
      open: (closed) => Database.open(closed),
      tabs: () => ({
        claim: (session) => {
          const isFree = !locks.has(session) || locks.get(session) === this;
          if (isFree) {
            locks.set(session, this);
          }
          return Promise.resolve(isFree);
        },
        release: (session) => {
          locks.delete(session);
        },
        open: () => Promise.resolve(new Set(locks.keys())),
      }),
      memory: () => ({
        getItem: (key) => this.memory.get(key) ?? null,
        setItem: (key, value) => {
          this.memory.set(key, value);
        },
      }),
      newId: () => `session-${ids++}`,
      now: () => clock++,
      hash: async (bytes) => Buffer.from(await crypto.subtle.digest('SHA-256', bytes)).toString('base64url'),
      read: async ({ name, bytes, picture, ofDemo }) => {
        await Promise.resolve();
        return () => {
          const file = { ...mesh(name), bytes, ...(picture === undefined ? {} : { picture }), ...(ofDemo === undefined ? {} : { ofDemo }) };
          this.made.push(file);
          return file;
        };
      },
      delay: DELAY,
      ...around,
    });
  }

  async visit(linked: string | null = null): Promise<this> {
    this.found = await this.keeper.find(linked);
    this.store.dispatch({ kind: 'ready', demos: [DEMO] });
    this.isResumed = await this.keeper.resume(this.found);
    return this;
  }

  /** Dispatches events, each as a step of its own. */
  does(...events: readonly Event[]): void {
    for (const event of events) {
      this.store.dispatch(event);
    }
  }

  /** Closes the tab, or begins a reload. */
  async close(): Promise<Map<string, string>> {
    await this.keeper.flush();
    for (const [session, tab] of [...locks]) {
      if (tab === this) {
        locks.delete(session);
      }
    }
    return this.memory;
  }

  get state(): State {
    return this.store.state;
  }
}

/** A tab with two meshes and four pairs, made in two steps, which were written. */
async function catAndLion(...more: readonly Event[]): Promise<Tab> {
  const tab = await new Tab().visit();
  tab.store.dispatch(...CAT_AND_LION);
  tab.does(pick(7), ...more);
  await tab.keeper.flush();
  return tab;
}

async function records(): Promise<SessionRecord[]> {
  return (await database.sessions()) as SessionRecord[];
}

async function meshNames(): Promise<string[]> {
  const raw = await openDB('conemap');
  const all = (await raw.getAll('meshes')) as Uint8Array[];
  raw.close();
  return all.map((bytes) => new TextDecoder().decode(bytes)).sort();
}

/** Changes a record as no page would do it. */
async function spoil(id: string, change: (record: Record<string, unknown>) => unknown): Promise<void> {
  const raw = await openDB('conemap');
  await raw.put('sessions', change((await raw.get('sessions', id)) as Record<string, unknown>));
  raw.close();
}

function contentOf({ meshes, up, demo, pairs, named, groundTruth, options }: State): unknown {
  const names = meshes.map((file) => (file === null ? null : [file.name, new TextDecoder().decode(file.bytes)]));
  return { names, up, demo, pairs: pairs.map(({ id, ...pair }) => ({ ...pair, isKnown: id > 0 })), named, groundTruth, options };
}

beforeEach(async () => {
  vi.stubGlobal('indexedDB', new IDBFactory());
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => {
    queueMicrotask(draw);
    return 0;
  });
  vi.spyOn(console, 'warn').mockReturnValue();
  locks = new Map();
  tabs = [];
  ids = 1;
  clock = 1;
  database = await Database.open(() => undefined);
});

afterEach(async () => {
  // A mesh is written at once: no writing may end in the next test.
  await Promise.all(tabs.map((tab) => tab.keeper.flush()));
  database.close();
});

describe('what is kept', () => {
  test('is nothing while nobody did anything: a demo that came by itself, a theme', async () => {
    const tab = await new Tab().visit();
    tab.store.dispatch(...CAT_AND_LION, { kind: 'demo', demo: DEMO });
    // The page begins the history a moment after the demo has come.
    await new Promise((resolve) => setTimeout(resolve, 20));
    tab.does({ kind: 'history-begun' }, { kind: 'ui', ui: { step: 'map' } });
    await tab.close();
    expect(await records()).toEqual([]);
  });

  test('is a mesh at once: its page may be closed in the same second', async () => {
    const tab = await new Tab().visit();
    tab.store.dispatch({ kind: 'mesh', side: 0, file: mesh('cat.off') });
    await vi.waitFor(async () => {
      expect(await meshNames()).toEqual(['cat.off']);
    });
    tab.store.dispatch({ kind: 'mesh', side: 1, file: mesh('lion.off') });
    await vi.waitFor(async () => {
      expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
    });
  });

  test('is every step, soon after it and gathered with those of the same moment', async () => {
    const written = vi.spyOn(Database.prototype, 'write');
    const tab = await new Tab(undefined, { delay: 5 }).visit();
    tab.store.dispatch(...CAT_AND_LION);
    await tab.keeper.flush();
    expect(written).toHaveBeenCalledTimes(1);
    written.mockClear();
    tab.does(pick(7));
    await vi.waitFor(() => {
      expect(written).toHaveBeenCalledTimes(1);
    });
    await tab.keeper.flush();
    tab.does(pick(8), pick(9), { kind: 'pair-labelled', id: 1, label: 'tip' });
    await vi.waitFor(() => {
      expect(written).toHaveBeenCalledTimes(2);
    });
    await tab.keeper.flush();
    const [record] = await records();
    expect(record?.work.pairs.map((place) => record.pairs[place]?.label)).toEqual(['tip', '', '', '', '', '', '']);
  });

  test('is a mesh once, however often landmarks change and under however many names', async () => {
    const put = vi.spyOn(IDBObjectStore.prototype, 'put');
    const tab = await catAndLion();
    const meshPuts = (): number => put.mock.calls.filter(([value]) => value instanceof Uint8Array).length;
    expect(meshPuts()).toBe(2);
    tab.does(pick(8), { kind: 'swap-meshes' });
    await tab.keeper.flush();
    tab.does({ kind: 'mesh', side: 0, file: { ...mesh('cat.off'), name: 'the same cat.off' } });
    await tab.keeper.flush();
    expect(meshPuts()).toBe(2);
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });

  test('is of a mesh’s bytes no more than the mesh', async () => {
    const tab = await new Tab().visit();
    const bytes = new TextEncoder().encode('archive: cat.off').subarray(9);
    tab.does({ kind: 'mesh', side: 0, file: { ...mesh('cat.off'), bytes } });
    await tab.keeper.flush();
    const [hash] = (await records())[0]?.hashes ?? [];
    const stored = await database.mesh(hash ?? '');
    expect([stored?.byteLength, stored?.buffer.byteLength]).toEqual([7, 7]);
  });

  test('is the picture that came with a mesh, which comes back with it and goes with it', async () => {
    const picture = new TextEncoder().encode('a picture of fur');
    const tab = await new Tab().visit();
    tab.does({ kind: 'mesh', side: 0, file: { ...mesh('cat.obj'), picture } }, { kind: 'mesh', side: 1, file: mesh('lion.obj') });
    const memory = await tab.close();
    expect(await meshNames()).toEqual(['a picture of fur', 'cat.obj', 'lion.obj']);
    const again = await new Tab(memory).visit();
    expect(again.state.meshes.map((file) => file?.picture)).toEqual([picture, undefined]);
    again.does({ kind: 'mesh', side: 0, file: mesh('cow.obj') }, { kind: 'history-begun' }, pick(30));
    await again.keeper.flush();
    expect(await meshNames()).toEqual(['cow.obj', 'lion.obj']);
  });

  test('is no mesh that no step leads to', async () => {
    const tab = await catAndLion({ kind: 'mesh', side: 1, file: mesh('cow.off') });
    expect(await meshNames()).toEqual(['cat.off', 'cow.off', 'lion.off']);
    tab.does({ kind: 'history-begun' }, pick(30));
    await tab.keeper.flush();
    expect(await meshNames()).toEqual(['cat.off', 'cow.off']);
  });

  test('is not the last map', async () => {
    await catAndLion();
    expect(JSON.stringify(await records())).not.toMatch(/"result"|"output"|"report"/);
  });

  test('of the steps around are the nearest whose meshes are not too large', () => {
    const large = (name: string): MeshFile => ({ ...mesh(name), bytes: new Uint8Array(12e6) });
    const store = new Store();
    store.dispatch(...CAT_AND_LION);
    for (const name of ['1', '2', '3', '4', '5']) {
      store.dispatch({ kind: 'mesh', side: 0, file: large(name) });
      store.dispatch(pick(Number(name)));
    }
    const { past, files } = keptOf(store.state);
    // The meshes of the page, which are 5 and lion.off, and two more.
    expect([...files].map(({ name }) => name)).toEqual(['5', 'lion.off', '4', '3']);
    expect(past[0]?.work.meshes[0]?.name).toBe('3');
  });
});

describe('a reload', () => {
  test('brings back the work, its steps in both directions, and how it was looked at', async () => {
    const tab = await catAndLion(
      { kind: 'mirrored', file: mesh('lion (mirrored).obj'), points: [20, 21, 22, 23, null] },
      { kind: 'up', side: 1, axis: '-z' },
      { kind: 'undo' },
      { kind: 'options', options: { ownCones: 10 } },
      { kind: 'pair-locked', id: 2, locked: true },
      { kind: 'undo' },
      { kind: 'ui', ui: { step: 'landmarks', panel: 'folded', link: 'map' } },
      { kind: 'camera-moved', side: 0, camera: [1, 2, 3] },
      { kind: 'style', style: { cones: false } },
    );
    const again = await new Tab(await tab.close()).visit();
    expect(again.isResumed).toBe(true);
    expect(contentOf(again.state)).toEqual(contentOf(tab.state));
    expect(again.state.ui).toEqual({ ...tab.state.ui, selected: null });
    expect(again.state.offer).toBeNull();
    const names = ({ history: { past, future } }: State): string[][] => [past.map(({ name }) => name), future.map(({ name }) => name)];
    expect(names(again.state)).toEqual(names(tab.state));
    for (const kind of ['redo', 'undo', 'undo', 'undo', 'undo', 'redo'] as const) {
      tab.does({ kind });
      again.does({ kind });
      expect(contentOf(again.state)).toEqual(contentOf(tab.state));
    }
  });

  test('goes on with its session, and ids go on, too', async () => {
    const tab = await catAndLion();
    const again = await new Tab(await tab.close()).visit();
    again.does({ kind: 'point-picked', side: 1, point: 17 }, pick(8));
    expect(new Set(again.state.pairs.map(({ id }) => id)).size).toBe(6);
    await again.close();
    expect((await records()).map(({ id, work }) => [id, work.pairs.length])).toEqual([['session-1', 6]]);
  });

  test('of a page that only shows a demo finds nothing', async () => {
    const tab = await new Tab().visit();
    const again = await new Tab(await tab.close()).visit();
    expect([again.isResumed, again.state.offer]).toEqual([false, null]);
  });

  test('says that the map of the work is missing until there is one again', async () => {
    const tab = await catAndLion();
    tab.does({ kind: 'run-started' }, { kind: 'run-done', output: OUTPUT, report: REPORT });
    const again = await new Tab(await tab.close()).visit();
    expect([isMapless(tab.state), isMapless(again.state)]).toEqual([false, true]);
    again.does({ kind: 'pair-deleted', id: again.state.pairs[0]?.id ?? 0 });
    const twice = await new Tab(await again.close()).visit();
    expect(isMapless(twice.state)).toBe(true);
    twice.does({ kind: 'swap-meshes' });
    expect(isMapless(twice.state)).toBe(false);
    twice.does({ kind: 'undo' }, { kind: 'run-started' }, { kind: 'run-done', output: OUTPUT, report: REPORT });
    expect(isMapless(twice.state)).toBe(false);
  });

  test('says nothing of a map that a first run had not made yet', async () => {
    const tab = await catAndLion();
    tab.does({ kind: 'run-started' });
    const again = await new Tab(await tab.close()).visit();
    expect([again.isResumed, isMapless(again.state)]).toEqual([true, false]);
    again.does({ kind: 'run-started' }, { kind: 'run-done', output: OUTPUT, report: REPORT }, { kind: 'run-started' });
    const twice = await new Tab(await again.close()).visit();
    expect(isMapless(twice.state)).toBe(true);
  });

  test('has work that was sent, before anything is done to it', async () => {
    const tab = await new Tab().visit();
    tab.store.dispatch({ kind: 'received', work: workOf(READY), ui: {} });
    const again = await new Tab(await tab.close()).visit();
    expect(contentOf(again.state)).toEqual(contentOf(tab.state));
  });

  test('knows the meshes of a demo after they were swapped', async () => {
    const tab = await new Tab().visit();
    const ofDemo = { id: DEMO.id, side: 0 } as const;
    tab.store.dispatch(...CAT_AND_LION, { kind: 'mesh', side: 0, file: { ...mesh('ball.obj'), ofDemo } });
    tab.store.dispatch({ kind: 'swap-meshes' });
    const again = await new Tab(await tab.close()).visit();
    expect(again.state.meshes.map((file) => file?.ofDemo)).toEqual([undefined, ofDemo]);
  });

  test('keeps a demo’s own work when the address still names the demo', async () => {
    const tab = await new Tab().visit();
    tab.store.dispatch(...CAT_AND_LION, { kind: 'demo', demo: DEMO });
    tab.does({ kind: 'history-begun' }, pick(7));
    const again = await new Tab(await tab.close()).visit('ball');
    expect(again.isResumed).toBe(true);
    expect(again.state.demo).toBe(DEMO);
    expect(again.state.pairs).toHaveLength(5);
  });

  test('at the address of another demo begins another session, and offers the work', async () => {
    const tab = await catAndLion();
    const again = await new Tab(await tab.close()).visit('ball');
    expect(again.isResumed).toBe(false);
    expect(again.state.offer).toMatchObject({ session: 'session-1', names: ['cat.off', 'lion.off'], pairs: 5 });
    again.does(pick(1));
    await again.close();
    expect((await records()).map(({ id }) => id).sort()).toEqual(['session-1', 'session-2']);
  });

  test('during which a file is opened gives way to it, and the work is offered', async () => {
    const memory = await (await catAndLion()).close();
    const tab = new Tab(memory);
    const found = await tab.keeper.find(null);
    tab.store.dispatch({ kind: 'ready', demos: [] });
    const resumed = tab.keeper.resume(found);
    const task = { sentence: 'Reading the files…' };
    tab.does({ kind: 'task-begun', task }, { kind: 'mesh', side: 0, file: mesh('cow.off') }, { kind: 'task-ended', task });
    expect(await resumed).toBe(false);
    expect(tab.state.meshes[0]?.name).toBe('cow.off');
    await tab.close();
    expect((await new Tab().visit()).state.offer).toMatchObject({ session: 'session-2', names: ['cow.off', null] });
    expect((await records()).map(({ id }) => id)).toEqual(['session-1', 'session-2']);
  });

  test('of a copied tab continues with a copy; both go on by themselves', async () => {
    const tab = await catAndLion();
    const copy = await new Tab(new Map(tab.memory)).visit();
    expect(copy.isResumed).toBe(true);
    copy.does(pick(8));
    tab.does({ kind: 'pairs-cleared' });
    await copy.close();
    await tab.close();
    const lengths = (await records()).map(({ id, work }) => [id, work.pairs.length]);
    expect(lengths).toEqual([
      ['session-1', 0],
      ['session-2', 6],
    ]);
  });
});

describe('a reload that comes before the page has let go', () => {
  /** Tabs in which a session is held until it was asked for once. */
  function lateTabs(session: string): () => Tabs {
    return () => ({
      claim: (name) => {
        const isFree = name !== session;
        locks.delete(session);
        return Promise.resolve(isFree);
      },
      release: () => undefined,
      open: () => Promise.resolve(new Set(locks.keys())),
    });
  }

  test('continues its session, and offers it to nobody', async () => {
    const before = await catAndLion();
    const tab = await new Tab(new Map(before.memory), { tabs: lateTabs('session-1') }).visit();
    expect(tab.isResumed).toBe(true);
    expect(tab.state.offer).toBeNull();
    expect(contentOf(tab.state)).toEqual(contentOf(before.state));
    await tab.keeper.flush();
    expect((await records()).map(({ id }) => id)).toEqual(['session-2']);
    const again = await new Tab(await tab.close()).visit();
    expect(again.isResumed).toBe(true);
    expect(again.state.offer).toBeNull();
  });

  test('and does not bring its work leaves that where it is', async () => {
    const before = await catAndLion();
    const read = (): Promise<never> => Promise.reject(new FileRefused('cat.off: it cannot be read'));
    const tab = await new Tab(new Map(before.memory), { tabs: lateTabs('session-1'), read }).visit();
    expect(tab.isResumed).toBe(false);
    tab.does({ kind: 'mesh', side: 0, file: mesh('cow.off') });
    await tab.close();
    expect((await records()).map(({ id }) => id)).toContain('session-1');
  });
});

describe('a new visit', () => {
  test('is offered the latest work that no tab has open', async () => {
    const first = await catAndLion();
    await first.close();
    const second = await catAndLion(pick(8));
    const third = await new Tab().visit();
    // The second tab is still open.
    expect(third.state.offer).toMatchObject({ session: 'session-1', pairs: 5 });
    await second.close();
    const fourth = await new Tab().visit();
    expect(fourth.state.offer).toMatchObject({ session: 'session-2', pairs: 6 });
  });

  test('that continues has the work with its steps, and one session in the end', async () => {
    const earlier = await catAndLion();
    await earlier.close();
    const tab = await new Tab().visit();
    await tab.keeper.accept();
    expect(tab.state.offer).toBeNull();
    expect(contentOf(tab.state)).toEqual(contentOf(earlier.state));
    tab.does({ kind: 'undo' });
    expect(tab.state.pairs).toHaveLength(4);
    await tab.close();
    expect((await records()).map(({ id }) => id)).toEqual(['session-2']);
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });

  test('cannot be continued while a run goes on, and is offered on', async () => {
    await (await catAndLion()).close();
    const tab = await new Tab().visit();
    tab.does({ kind: 'run-started' });
    await tab.keeper.accept();
    expect(tab.state).toMatchObject({ offer: { session: 'session-1' }, pairs: [], error: expect.stringContaining('Cancel it first') as string });
    tab.does({ kind: 'run-cancelled' });
    await tab.keeper.accept();
    expect([tab.state.offer, tab.state.pairs.length]).toEqual([null, 5]);
  });

  test('that continues after a step of its own can take that back', async () => {
    const earlier = await catAndLion();
    await earlier.close();
    const tab = await new Tab().visit();
    tab.does({ kind: 'landmarks', file: { pairs: [[1, 2]] } });
    await tab.keeper.accept();
    expect(tab.state.toast).toEqual({ sentence: 'Continued with cat and lion.', undo: true });
    expect(tab.state.pairs).toHaveLength(5);
    tab.does({ kind: 'undo' });
    expect(tab.state.pairs.map(({ points }) => points)).toEqual([[1, 2]]);
  });

  test('that begins anew is not asked again, and the work stays for a while', async () => {
    await (await catAndLion()).close();
    const tab = await new Tab().visit();
    await tab.keeper.decline();
    expect(tab.state.offer).toBeNull();
    await tab.close();
    expect((await new Tab().visit()).state.offer).toBeNull();
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });

  test('drops all but the latest five sessions, and their meshes', async () => {
    for (let index = 1; index <= 7; index++) {
      const tab = await new Tab().visit();
      tab.does({ kind: 'mesh', side: 0, file: mesh(`${index}.off`) }, pick(1));
      await tab.close();
    }
    await new Tab().visit();
    expect((await records()).map(({ id }) => id)).toEqual([3, 4, 5, 6, 7].map((index) => `session-${index}`));
    expect(await meshNames()).toEqual([3, 4, 5, 6, 7].map((index) => `${index}.off`));
  });

  test('drops no session that a tab has open, however old', async () => {
    const old = await catAndLion();
    for (let index = 1; index <= 6; index++) {
      const tab = await new Tab().visit();
      tab.does({ kind: 'mesh', side: 0, file: mesh(`${index}.off`) });
      await tab.close();
    }
    await new Tab().visit();
    expect((await records()).map(({ id }) => id)).toContain('session-1');
    old.does(pick(9));
    const again = await new Tab(await old.close()).visit();
    expect(again.state.pairs).toHaveLength(6);
  });
});

test('two tabs do not disturb each other', async () => {
  const [one, other] = [await catAndLion(), await new Tab().visit()];
  other.does({ kind: 'mesh', side: 0, file: mesh('cow.off') });
  one.does({ kind: 'pairs-cleared' });
  await other.keeper.flush();
  await one.keeper.flush();
  const [again, otherAgain] = [await new Tab(await one.close()).visit(), await new Tab(await other.close()).visit()];
  expect(contentOf(again.state)).toEqual(contentOf(one.state));
  expect(contentOf(otherAgain.state)).toEqual(contentOf(other.state));
});

describe('what cannot be read', () => {
  type Spoil = (record: Record<string, unknown>) => unknown;
  const inWork =
    (patch: Record<string, unknown>): Spoil =>
    (record) => ({ ...record, work: { ...(record['work'] as object), ...patch } });
  const withPairs =
    (...pairs: readonly unknown[]): Spoil =>
    (record) => ({ ...inWork({ pairs: pairs.map((_, place) => place) })({ ...record, past: [], future: [] }) as object, pairs });
  const pairOf = (patch: Record<string, unknown>): unknown => ({ id: 1, number: 1, points: [1, 2], label: '', locked: false, ...patch });

  test.each<[string, Spoil]>([
    ['no work', (record) => ({ ...record, work: undefined })],
    ['pairs that are no list', inWork({ pairs: 'many' })],
    ['a negative vertex', withPairs(pairOf({ points: [-1, 2] }))],
    ['a vertex that is no number', withPairs(pairOf({ points: ['1', 2] }))],
    ['weights that are not finite', withPairs(pairOf({ points: [{ face: 1, barycentric: [Number.NaN, 0, 1] }, 2] }))],
    ['a pair without points', withPairs(pairOf({ points: [null, null] }))],
    ['two pairs of one number', withPairs(pairOf({}), pairOf({ id: 2 }))],
    ['two pairs of one id', withPairs(pairOf({}), pairOf({ number: 2 }))],
    ['a pair that is not there', inWork({ pairs: [0, 1, 99] })],
    ['one pair twice', inWork({ pairs: [0, 0] })],
    ['places that are none', inWork({ pairs: [0.5] })],
    ['a direction that there is not', inWork({ up: ['w', 'y'] })],
    ['a method that there is not', inWork({ options: { method: 'magic' } })],
    ['a hash that is none', inWork({ meshes: [{ name: 'cat.off', hash: '../../etc' }, null] })],
    ['a label without end', withPairs(pairOf({ label: 'x'.repeat(1e6) }))],
    ['steps that are none', (record) => ({ ...record, past: [{ name: 'Step' }] })],
  ])('is left out with a sentence and removed: %s', async (_, change) => {
    await (await catAndLion()).close();
    await spoil('session-1', change);
    const tab = await new Tab().visit();
    expect([tab.isResumed, tab.state.offer]).toEqual([false, null]);
    expect(tab.state.toast?.sentence).toMatch(/could not be read/);
    expect(await records()).toEqual([]);
    expect(await meshNames()).toEqual([]);
  });

  test('of another version stays as it is, with a sentence', async () => {
    await (await catAndLion()).close();
    await spoil('session-1', (record) => ({ ...record, version: 2, work: 'in another form' }));
    const tab = await new Tab().visit();
    expect(tab.state.toast?.sentence).toMatch(/another version/);
    expect(await records()).toHaveLength(1);
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });

  test('and is this tab’s own is not written over', async () => {
    const memory = await (await catAndLion()).close();
    await spoil('session-1', (record) => ({ ...record, version: 2 }));
    const tab = await new Tab(memory).visit();
    expect(tab.isResumed).toBe(false);
    tab.does(pick(1));
    await tab.close();
    expect((await records()).map(({ id }) => id)).toEqual(['session-1', 'session-2']);
  });

  test('for want of the program is offered again', async () => {
    const memory = await (await catAndLion()).close();
    const read = (): Promise<never> => Promise.reject(new FileRefused('cat.off: no program', { failure: { code: 'no-core', message: 'status 503' } }));
    const tab = await new Tab(memory, { read }).visit();
    expect([tab.isResumed, tab.state.error]).toEqual([false, 'cat.off: no program']);
    await tab.close();
    const next = await new Tab().visit();
    expect(next.state.offer?.names).toEqual(['cat.off', 'lion.off']);
  });

  test.each<[string, () => Promise<void>]>([
    ['a mesh is gone', async () => {
      const raw = await openDB('conemap');
      await raw.clear('meshes');
      raw.close();
    }],
    ['a mesh is none', async () => {
      const raw = await openDB('conemap');
      for (const key of await raw.getAllKeys('meshes')) {
        await raw.put('meshes', 'text', key);
      }
      raw.close();
    }],
    ['a point is none of its mesh', () => spoil('session-1', withPairs(pairOf({ points: [5000, 2] })))],
    ['a half pair’s point is none of its mesh', () => spoil('session-1', withPairs(pairOf({ points: [null, 5000] })))],
  ])('says so and leaves the page to others where %s', async (_, damage) => {
    const memory = await (await catAndLion()).close();
    await damage();
    const tab = await new Tab(memory).visit();
    expect(tab.isResumed).toBe(false);
    expect(tab.state.error).toMatch(/could not be read/);
    expect(tab.state.meshes).toEqual([null, null]);
    expect(tab.state.job.kind).toBe('idle');
    expect(tab.made.map((file) => file.freed())).toEqual(tab.made.map(() => 1));
    tab.does(pick(1));
    const next = await new Tab(await tab.close()).visit();
    expect(next.state.pairs).toHaveLength(1);
    expect((await new Tab().visit()).state.offer).toBeNull();
  });

  test('of how it was looked at is as at the start, and the work is there', async () => {
    const memory = await (await catAndLion()).close();
    await spoil('session-1', (record) => ({ ...record, ui: { step: 'cooking', style: { surface: 'plaid' }, cameras: [['x'], null] } }));
    const tab = await new Tab(memory).visit();
    expect(tab.state.pairs).toHaveLength(5);
    expect(tab.state.ui).toMatchObject({ step: 'meshes', cameras: [null, null], style: READY.ui.style });
  });

  test('of the steps alone leaves the work without steps', async () => {
    const memory = await (await catAndLion()).close();
    await spoil('session-1', (record) => {
      const pairs = record['pairs'] as unknown[];
      const bad = { ...(record['work'] as object), pairs: [pairs.length] };
      return { ...record, pairs: [...pairs, pairOf({ points: [5000, 2] })], past: [{ name: 'Step', work: bad }] };
    });
    const tab = await new Tab(memory).visit();
    expect([tab.state.pairs.length, tab.state.history.past.length]).toEqual([5, 0]);
  });
});

describe('a store that fails', () => {
  const full = new DOMException('', 'QuotaExceededError');

  test('for want of room is told once, and tried again with the next step', async () => {
    const tab = await new Tab().visit();
    const write = vi.spyOn(Database.prototype, 'write').mockRejectedValueOnce(full).mockRejectedValueOnce(full);
    tab.store.dispatch(...CAT_AND_LION);
    await tab.keeper.flush();
    expect(tab.state.toast).toEqual({ sentence: expect.stringMatching(/no room/) as string, undo: false });
    tab.does({ kind: 'toast-closed' }, pick(7));
    await tab.keeper.flush();
    expect(tab.state.toast).toBeNull();
    tab.does(pick(8));
    await tab.close();
    expect(write).toHaveBeenCalledTimes(3);
    expect((await records())[0]?.work.pairs).toHaveLength(6);
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });

  test.each<[string, Partial<Surroundings>]>([
    ['the store', { open: () => Promise.reject(new Error('private mode')) }],
    ['locks', { tabs: () => { throw new TypeError('no locks'); } }],
    ['the memory of a tab', { memory: () => { throw new DOMException('', 'SecurityError'); } }],
  ])('because the browser refuses %s is told, and the page works', async (_, around) => {
    const tab = await new Tab(undefined, around).visit();
    expect(tab.isResumed).toBe(false);
    expect(tab.state.toast?.sentence).toMatch(/keep nothing/);
    tab.store.dispatch(...CAT_AND_LION);
    await tab.close();
    await tab.keeper.accept();
    await tab.keeper.decline();
    expect(tab.state.pairs).toHaveLength(4);
    expect(await records()).toEqual([]);
  });

  test('because the browser gives no hashes is told', async () => {
    const tab = await new Tab(undefined, { hash: () => Promise.resolve(null) }).visit();
    tab.store.dispatch(...CAT_AND_LION);
    await tab.keeper.flush();
    expect(tab.state.toast?.sentence).toMatch(/not kept/);
  });

  test('because a newer page needs it is told, and no more is written', async () => {
    let close = (): void => undefined;
    const tab = await new Tab(undefined, {
      open: (closed) => {
        close = closed;
        return Database.open(closed);
      },
    }).visit();
    close();
    expect(tab.state.toast?.sentence).toMatch(/not kept/);
    tab.store.dispatch(...CAT_AND_LION);
    await tab.close();
    expect(await records()).toEqual([]);
  });

  test('half way leaves nothing half', async () => {
    const tab = await catAndLion();
    const kept = keptOf(tab.state);
    const hashes = new Map([...kept.files].map((file) => [file.bytes, 'x'.repeat(43)] as const));
    const record = recordOf(kept, { id: 'other', saved: 1, ui: tab.state.ui, hadMap: false }, hashes);
    const fresh = new Map([['new', new Uint8Array(1)]]);
    const broken = { ...record, work: { ...record.work, groundTruth: (() => undefined) as unknown as string } };
    await expect(database.write({ record: broken, fresh, dropped: [], absorbed: 'session-1' })).rejects.toThrow();
    expect((await records()).map(({ id }) => id)).toEqual(['session-1']);
    expect(await meshNames()).toEqual(['cat.off', 'lion.off']);
  });
});

test('a record is what its reader takes', async () => {
  const tab = await catAndLion();
  const [record] = await records();
  expect(readSession(structuredClone(record)).kind).toBe('session');
  // Steps share what has not changed, as they do in memory.
  expect(record?.past.length).toBeGreaterThan(0);
  expect(tab.state.history.past.length).toBe(record?.past.length);
  expect(readSession(null)).toEqual({ kind: 'broken' });
  expect(readSession({ version: 7 })).toEqual({ kind: 'other-version' });
});
