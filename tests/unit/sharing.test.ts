/** What is on the page is sent and opened on another page, with the core and without a browser. */
import { afterEach, beforeAll, beforeEach, describe, expect, test, vi } from 'vitest';
import { Links } from '../../www/app/links.ts';
import { buildDemo, demoEvents, followDemo } from '../../www/app/open.ts';
import { arrivingOf } from '../../www/app/projects.ts';
import { place, sentWorkOf, withMeshes } from '../../www/app/sent-work.ts';
import { sharedLink } from '../../www/app/sharing.ts';
import type { Link } from '../../www/send/link.ts';
import { readLink, writeLink } from '../../www/send/link.ts';
import { ReaderBroken } from '../../www/reading/asked-worker.ts';
import type { FileReader } from '../../www/reading/reader.ts';
import type { NamedBytes } from '../../www/named-file.ts';
import type { SentWork } from '../../www/send/schema.ts';
import { Store } from '../../www/store/store.ts';
import { Random } from './random.ts';
import { meshFile, READER, readFile } from './reading.ts';
import { startModules } from './modules.ts';

const BASE = 'https://maps.example/conemap/';

beforeAll(() => {
  startModules();
});

/** The bytes of an octahedron, stretched to this height. */
function octahedron(height: number): Uint8Array {
  const vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, height], [0, 0, -height]];
  const faces = [[1, 3, 5], [3, 2, 5], [2, 4, 5], [4, 1, 5], [3, 1, 6], [2, 3, 6], [4, 2, 6], [1, 4, 6]];
  const lines = [...vertices.map((vertex) => `v ${vertex.join(' ')}`), ...faces.map((face) => `f ${face.join(' ')}`), ''];
  return new TextEncoder().encode(lines.join('\n'));
}

/** The hash of the page's address, as it is read and written. */
const address = { hash: '' };

beforeEach(() => {
  address.hash = '';
  vi.stubGlobal('location', {
    get hash() {
      return address.hash;
    },
    pathname: '/conemap/',
    search: '',
  });
  vi.stubGlobal('document', { baseURI: BASE });
  vi.stubGlobal('history', {
    replaceState: (_state: unknown, _title: string, url: string) => {
      address.hash = new URL(url, BASE).hash;
    },
  });
  vi.stubGlobal('requestAnimationFrame', (callback: () => void) => setTimeout(callback, 0));
});
afterEach(() => {
  vi.unstubAllGlobals();
});

/** A page with two meshes, four pairs, and views that the user has changed. */
function page(addresses: readonly [string?, string?] = []): Store {
  const store = new Store();
  const file = (name: string, height: number, from: string | undefined): ReturnType<typeof meshFile> =>
    meshFile({ name, bytes: octahedron(height), ...(from === undefined ? {} : { address: from }) });
  store.dispatch(
    { kind: 'ready', demos: [] },
    { kind: 'mesh', side: 0, file: file('cat.obj', 1, addresses[0]) },
    { kind: 'mesh', side: 1, file: file('lion.obj', 2, addresses[1]) },
    { kind: 'landmarks', file: { pairs: [[0, 0], [1, 1], [2, 2], [{ face: 3, barycentric: [0.2, 0.3, 0.5] }, 4]], labels: ['a', '', '', 'd'] } },
  );
  store.dispatch({ kind: 'point-picked', side: 0, point: { face: 5, barycentric: [0.25, 0.25, 0.5] } });
  store.dispatch({ kind: 'up', side: 1, axis: '-z' });
  store.dispatch({ kind: 'camera-moved', side: 0, camera: [1, 2, 3] });
  return store;
}

async function linkOf(store: Store): Promise<{ readonly link: Link; readonly hash: string }> {
  const shared = await sharedLink(store.state, new URL(BASE));
  const { hash } = new URL(shared?.url ?? BASE);
  const reading = readLink(hash, new URL(BASE));
  if (reading.kind !== 'link') {
    throw new Error('no link');
  }
  return { link: reading.link, hash };
}

async function until(isSo: () => boolean): Promise<void> {
  await vi.waitFor(() => {
    expect(isSo()).toBe(true);
  });
}

describe('a link', () => {
  test('says all of the work, half pairs and how the meshes stand too', async () => {
    const store = page();
    const { link } = await linkOf(store);
    expect(link.work).toEqual(sentWorkOf(store.state));
    expect(link.work?.pairs).toHaveLength(5);
    expect(link.files.map((file) => file?.kind)).toEqual(['local', 'local']);
  });

  test('speaks of a mesh by its address where it has one, and never of another host’s by hash', async () => {
    const { link } = await linkOf(page(['https://data.example/cat.obj', 'http://broken']));
    expect(link.files.map((file) => file?.kind)).toEqual(['address', 'local']);
  });

  test('is none of an empty page, none that is too long, and none of files where the page may not hash them', async () => {
    expect(await sharedLink(new Store().state, new URL(BASE))).toBeNull();
    const store = page();
    store.dispatch({ kind: 'pair-labelled', id: store.state.pairs[0]?.id ?? 0, label: [...new Random(31).bytes(40_000)].join() });
    expect(await sharedLink(store.state, new URL(BASE))).toBeNull();
    vi.stubGlobal('crypto', {});
    expect(await sharedLink(page().state, new URL(BASE))).toBeNull();
  });

  test('opens on another page, with files by hand, as one step', async () => {
    const sender = page();
    const { hash } = await linkOf(sender);
    const receiver = page();
    receiver.dispatch({ kind: 'pairs-cleared' });
    const before = sentWorkOf(receiver.state);
    const links = new Links(receiver, READER);
    address.hash = hash;
    expect(await links.follow()).toBe('followed');
    expect(receiver.state.receiving).toMatchObject({ kind: 'files' });
    await links.take([
      { name: 'cat.obj', bytes: octahedron(3) },
      { name: 'x.obj', bytes: octahedron(2) },
    ]);
    expect(receiver.state.error).toMatch(/^cat\.obj is not a file of this link\. The name fits/);
    await links.take([{ name: 'cat.obj', bytes: octahedron(1) }]);
    await until(() => receiver.state.pairs.length === 5);
    expect(receiver.state.error).toBeNull();
    expect(sentWorkOf(receiver.state)).toEqual(sentWorkOf(sender.state));
    expect(receiver.state.meshes.map((file) => file?.name)).toEqual(['cat.obj', 'lion.obj']);
    expect(address.hash).toBe('');
    receiver.dispatch({ kind: 'undo' });
    expect(sentWorkOf(receiver.state).pairs).toEqual(before.pairs);
  });

  test('opens from another host after its click, and can be sent on', async () => {
    const asked: string[] = [];
    vi.stubGlobal('fetch', async (url: string) => {
      asked.push(url);
      return Promise.resolve(new Response(octahedron(url.includes('cat') ? 1 : 2) as BodyInit));
    });
    const sender = page(['https://data.example/cat.obj', 'https://data.example/lion.obj']);
    const { hash } = await linkOf(sender);
    const receiver = new Store();
    receiver.dispatch({ kind: 'ready', demos: [] });
    const links = new Links(receiver, READER);
    address.hash = hash;
    await links.follow();
    expect(receiver.state.receiving).toEqual({ kind: 'click', hosts: [{ host: 'data.example', names: ['cat.obj', 'lion.obj'] }] });
    expect(asked).toEqual([]);
    links.accept();
    await until(() => receiver.state.pairs.length === 5);
    expect(asked).toHaveLength(2);
    expect((await linkOf(receiver)).hash).toBe(hash);
  });

  test('to a demo whose meshes were swapped asks for no files', async () => {
    const sender = new Store();
    const demo = { id: 'sphere-tetrahedron', title: 'Ball', sentence: '' };
    sender.dispatch(...demoEvents(demo, await buildDemo(READER, demo, new AbortController().signal)));
    sender.dispatch({ kind: 'swap-meshes' });
    const { hash } = await linkOf(sender);
    const receiver = new Store();
    receiver.dispatch({ kind: 'ready', demos: [demo] });
    address.hash = hash;
    await new Links(receiver, READER).follow();
    await until(() => receiver.state.pairs.length > 0);
    expect(receiver.state.meshes.map((file) => file?.name)).toEqual(['sphere-tetrahedron-target.obj', 'sphere-tetrahedron-source.obj']);
    expect(sentWorkOf(receiver.state)).toEqual(sentWorkOf(sender.state));
    expect((await linkOf(receiver)).hash).toBe(hash);
  });

  test('to such a demo asks for no files after it came in a project file either, where the page has the demo', () => {
    const ofDemo = { id: 'sphere-tetrahedron', side: 1 } as const;
    const mesh = { name: 'ball.obj', bytes: octahedron(1), address: null };
    expect(arrivingOf({ ...mesh, ofDemo }, [{ id: ofDemo.id }])).toEqual({ ...mesh, ofDemo });
    expect(arrivingOf({ ...mesh, ofDemo }, [{ id: 'other' }])).toEqual(mesh);
    expect(arrivingOf(mesh, [{ id: ofDemo.id }])).toEqual(mesh);
    expect(arrivingOf(null, [])).toBeNull();
  });

  test('waits while a run goes on, and is opened by a click after it', async () => {
    vi.stubGlobal('fetch', async (url: string) => Promise.resolve(new Response(octahedron(url.includes('cat') ? 1 : 2) as BodyInit)));
    const { hash } = await linkOf(page(['https://data.example/cat.obj', 'https://data.example/lion.obj']));
    const receiver = new Store();
    receiver.dispatch({ kind: 'ready', demos: [] });
    const links = new Links(receiver, READER);
    address.hash = hash;
    await links.follow();
    receiver.dispatch({ kind: 'run-started' });
    links.accept();
    expect(receiver.state).toMatchObject({ receiving: { kind: 'click' }, error: expect.stringContaining('Cancel it first') as string });
    receiver.dispatch({ kind: 'run-cancelled' });
    links.accept();
    // A run that begins while the files come is not given up for them either.
    receiver.dispatch({ kind: 'run-started' });
    await until(() => receiver.state.receiving.kind === 'nothing');
    expect(receiver.state).toMatchObject({ pairs: [], job: { kind: 'running' }, error: expect.stringContaining('Cancel it first') as string });
    expect(address.hash).toBe(hash);
  });

  test('whose files cannot be loaded stays in the address until other work is on the page', async () => {
    vi.stubGlobal('fetch', async () => Promise.resolve(new Response('', { status: 503 })));
    const receiver = page();
    address.hash = '#source=a.obj&target=b.obj';
    await new Links(receiver, READER).follow();
    await until(() => receiver.state.error?.includes('503') === true);
    receiver.dispatch({ kind: 'error-closed' });
    expect(address.hash).toBe('#source=a.obj&target=b.obj');
    receiver.dispatch({ kind: 'pair-deleted', id: 1 });
    expect(address.hash).toBe('');
  });

  test('that no reload can mend leaves the address', async () => {
    const sender = page(['https://data.example/cat.obj', 'https://data.example/lion.obj']);
    const answers = { cat: octahedron(1) };
    vi.stubGlobal('fetch', async (url: string) => Promise.resolve(new Response((url.includes('cat') ? answers.cat : octahedron(2)) as BodyInit)));
    const store = page();
    const links = new Links(store, READER);
    const { link, hash } = await linkOf(sender);
    const misplaced = link.work?.pairs.map((pair) => ({ ...pair, points: [77, 1] as const })).slice(0, 1) ?? [];
    const half = writeLink({ ...link, work: link.work && { ...link.work, pairs: misplaced } });
    const noDemo = writeLink({ ...link, files: [{ kind: 'demo', id: 'none', side: 0 }, null] });
    const noDemoWork = writeLink({ ...link, demo: 'none', files: [null, null] });
    for (const [bad, sentence] of [[half, 'The link'], [noDemo, 'no demo'], [noDemoWork, 'no demo'], ['#demo=none', 'no demo']] as const) {
      store.dispatch({ kind: 'error-closed' });
      address.hash = bad;
      await links.follow();
      links.accept();
      await until(() => store.state.error?.includes(sentence) === true);
      await until(() => address.hash === '');
    }
    answers.cat = new TextEncoder().encode('none\n');
    address.hash = hash;
    await links.follow();
    links.accept();
    await until(() => store.state.error?.includes('cat.obj') === true && address.hash === '');
  });

  test('stays in the address where the program did not load', async () => {
    const reader: FileReader = {
      ask: async () => Promise.reject(new ReaderBroken({ code: 'no-core', message: 'offline' })),
    };
    const demo = { id: 'sphere-tetrahedron', title: 'Ball', sentence: '' };
    const store = page();
    store.dispatch({ kind: 'ready', demos: [demo] });
    const { link } = await linkOf(page());
    const links = new Links(store, reader);
    for (const hash of [
      writeLink({ ...link, demo: demo.id, files: [null, null] }),
      writeLink({ ...link, files: [{ kind: 'demo', id: demo.id, side: 0 }, null] }),
    ]) {
      store.dispatch({ kind: 'error-closed' });
      address.hash = hash;
      await links.follow();
      await until(() => store.state.error !== null && store.state.job.kind !== 'busy');
      expect(address.hash).toBe(hash);
    }
    store.dispatch({ kind: 'pair-deleted', id: 1 });
    expect(address.hash).toBe('');
  });

  test('leaves the address to another one that has come while it was opened', async () => {
    const demo = { id: 'sphere-tetrahedron', title: 'Ball', sentence: '' };
    const { hash: waiting, link } = await linkOf(page());
    const store = new Store();
    store.dispatch({ kind: 'ready', demos: [demo] });
    store.subscribe(followDemo);
    const links = new Links(store, READER);
    address.hash = writeLink({ ...link, demo: demo.id, files: [null, null], work: link.work && { ...link.work, pairs: [] } });
    const opening = links.follow();
    address.hash = waiting;
    await links.follow();
    await opening;
    expect(store.state).toMatchObject({ demo, receiving: { kind: 'files' } });
    expect(address.hash).toBe(waiting);
    links.cancel();
    expect(address.hash).toBe(`#demo=${demo.id}`);
  });

  test('of addresses brings meshes and landmarks', async () => {
    vi.stubGlobal('fetch', async (url: string) =>
      Promise.resolve(new Response(url.endsWith('.json') ? '{"pairs":[[0,1],[1,0],[2,2],[3,3]]}' : (octahedron(1) as BodyInit))),
    );
    const store = new Store();
    store.dispatch({ kind: 'ready', demos: [] });
    const links = new Links(store, READER);
    address.hash = '#source=a.obj&target=b.obj&landmarks=c.json';
    await links.follow();
    await until(() => store.state.pairs.length === 4);
    expect(store.state.meshes.map((file) => file?.address)).toEqual([`${BASE}a.obj`, `${BASE}b.obj`]);
    address.hash = '#source=a.obj&landmarks=c.json';
    vi.stubGlobal('fetch', async (url: string) =>
      Promise.resolve(new Response(url.endsWith('.json') ? '{"pairs":[[0,1],[77,0],[2,2],[3,3]]}' : (octahedron(2) as BodyInit))),
    );
    await links.follow();
    await until(() => store.state.error !== null);
    expect(store.state.error).toContain('c.json');
    expect(store.state.pairs).toHaveLength(4);
  });

  test('that is refused says why and changes nothing', async () => {
    const store = page();
    const links = new Links(store, READER);
    const before = store.state.pairs;
    for (const [hash, sentence] of [
      ['#s=3.AAAA', 'newer version'],
      ['#s=1.AAAA', 'damaged'],
      ['#demo=none', 'no demo'],
      ['#source=http://data.example/cat.obj', 'https'],
    ] as const) {
      address.hash = hash;
      expect(await links.follow()).toBe('followed');
      expect(store.state.error).toContain(sentence);
    }
    address.hash = '#top';
    expect(await links.follow()).toBe('none');
    expect(store.state.pairs).toBe(before);
  });
});

describe('work that was sent', () => {
  const file = (height: number): NamedBytes => ({ name: `${height}.obj`, bytes: octahedron(height) });

  function placed(change: Partial<SentWork>): string {
    const store = new Store();
    try {
      withMeshes([readFile(file(1)), readFile(file(2))], (loaded) => {
        place(store, 'The link', { ...sentWorkOf(page().state), ...change }, loaded, null);
      });
      return `${store.state.pairs.length} pairs`;
    } catch (thrown) {
      expect(store.state.meshes).toEqual([null, null]);
      return thrown instanceof Error ? thrown.message : '';
    }
  }

  test('is refused where its points are none of the meshes, whole or half', () => {
    const pair = (source: number, target: number | null): SentWork['pairs'] => [
      { number: 1, points: [source, target], label: '', locked: false },
    ];
    expect(placed({})).toBe('5 pairs');
    expect(placed({ pairs: [] })).toBe('0 pairs');
    expect(placed({ pairs: pair(5, 5) })).toBe('1 pairs');
    expect(placed({ pairs: pair(6, 5) })).toMatch(/^The link: /);
    expect(placed({ pairs: pair(6, null) })).toMatch(/^The link: /);
  });
});
