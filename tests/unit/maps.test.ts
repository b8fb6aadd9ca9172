/** Map files that are opened on the page, with the core itself in place of the worker. */
import { beforeAll, beforeEach, describe, expect, test, vi } from 'vitest';
import { Maps } from '../../www/app/maps.ts';
import { openFiles } from '../../www/app/open.ts';
import { failureOf } from '../../www/compute/messages.ts';
import type { SavedMapHandle } from '../../www/compute/saved-client.ts';
import type { SavedFiles } from '../../www/compute/saved-messages.ts';
import { openedOf, viewBuffers } from '../../www/compute/view-buffers.ts';
import { landmarkFile } from '../../www/files.ts';
import type { NamedBytes } from '../../www/files.ts';
import { headOf, isMapFile } from '../../www/map-files.ts';
import type { Report } from '../../www/report.ts';
import { reportIn } from '../../www/send/report.ts';
import type { Event } from '../../www/store/events.ts';
import { isCurrent, shownResult, staleness } from '../../www/store/staleness.ts';
import type { Demo } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import { buildDemo, demoList, openMap, runMap } from '../../www/wasm/core.js';
import { after } from './fixtures.ts';
import { meshFile, READER } from './reading.ts';
import { refusal } from './refusal.ts';
import { startCoreModule, startModules } from './modules.ts';

vi.mock('../../www/compute/saved-client.ts', async (original) => {
  const { SavedMapError } = await original<typeof import('../../www/compute/saved-client.ts')>();
  const opened = async ({ map, source, target }: SavedFiles): Promise<ReturnType<typeof openedOf>> => {
    await Promise.resolve();
    try {
      return openedOf(openMap(map, source, target), null);
    } catch (thrown) {
      throw new SavedMapError({ ...failureOf(thrown), side: null });
    }
  };
  return {
    SavedMapError,
    openSavedMap: (_: unknown, files: SavedFiles): Partial<SavedMapHandle> => ({ opened: opened(files), close: () => undefined }),
  };
});

const NO_LISTENER = { relaxes: () => undefined, progress: () => undefined, preview: () => undefined, found: () => undefined, wantsResult: () => false };

let source: NamedBytes;
let target: NamedBytes;
let landmarks: NamedBytes;
let map: NamedBytes;
let files: { readonly glb: Uint8Array; readonly csv: Uint8Array; readonly baseObj: Uint8Array };
let made: { readonly report: Report; readonly buffers: ReturnType<typeof viewBuffers> };
let store: Store;
let maps: Maps;

beforeAll(() => {
  startCoreModule();
  startModules();
  const demo = buildDemo((JSON.parse(demoList()) as Demo[]).at(-1)?.id ?? '');
  if (demo === undefined) {
    throw new Error('the demo is gone');
  }
  source = { name: 'ball.obj', bytes: demo.source() };
  target = { name: 'body.obj', bytes: demo.target() };
  const file = { ...landmarkFile({ name: 'a.json', bytes: demo.landmarks() }), source: 'ball.obj', target: 'body.obj' };
  landmarks = { name: 'pairs.json', bytes: new TextEncoder().encode(JSON.stringify(file)) };
  const output = runMap(source.bytes, target.bytes, JSON.stringify(file), '{"ownCones": 0}', NO_LISTENER);
  made = { report: JSON.parse(output.report()) as Report, buffers: viewBuffers(output) };
  files = { glb: output.glb(source.bytes, target.bytes), csv: output.csv(), baseObj: output.baseObj() };
  const bytes = output.mapFile();
  if (bytes === undefined) {
    throw new Error('the map has no file');
  }
  map = { name: 'ball.conemap', bytes };
});

beforeEach(() => {
  vi.stubGlobal('requestAnimationFrame', (draw: () => void) => {
    queueMicrotask(draw);
    return 0;
  });
  store = new Store();
  maps = new Maps(store, () => ({}));
  store.dispatch({ kind: 'ready', demos: [] });
});

async function drop(...files: readonly NamedBytes[]): Promise<void> {
  await openFiles(
    store,
    { reader: READER, maps },
    files.map(({ name, bytes }) => new File([bytes.slice()], name)),
    null,
  );
}

type Numbers = Uint8Array | Uint32Array | Float32Array | Float64Array;

/** Whether all bytes are the same; the test library would take seconds for this. */
function areSame(a: Numbers | null | undefined, b: Numbers): boolean {
  const bytes = ({ buffer, byteOffset, byteLength }: Numbers): Buffer => Buffer.from(buffer, byteOffset, byteLength);
  return a !== null && a !== undefined && bytes(a).equals(bytes(b));
}

const steps = (): string[] => store.state.history.past.map(({ name }) => name);

describe('a map file', () => {
  test('with its meshes, in any order, brings the finished map as a run gives it', async () => {
    await drop(target, map, source);
    const { result, meshes, pairs, options, job, error } = store.state;
    expect(error).toBeNull();
    expect(meshes.map((mesh) => mesh?.name)).toEqual(['ball.obj', 'body.obj']);
    expect(pairs).toHaveLength(made.report.base_domain.vertices);
    expect([options.ownCones, job.kind, isCurrent(store.state)]).toEqual([0, 'done', true]);
    expect(result?.opened).toEqual({ name: 'ball.conemap', isMirrored: false });
    // The report is that of the run with all its fields, but with new measurements.
    expect(result?.report.certificate).toEqual(made.report.certificate);
    expect(Object.keys(result?.report ?? {}).toSorted()).toEqual(Object.keys(made.report).toSorted());
    expect(result?.report.distortion.energy).toBeCloseTo(made.report.distortion.energy, 9);
    expect(result?.report.distortion.worst).toHaveLength(made.report.distortion.worst.length);
    const { sides, triangles, distortion, cones } = made.buffers;
    expect(areSame(result?.output.triangles, triangles)).toBe(true);
    expect(areSame(result?.output.cones, cones)).toBe(true);
    for (const side of [0, 1] as const) {
      expect(areSame(result?.output.sides[side].positions, sides[side].positions)).toBe(true);
    }
    expect(result?.output.distortion).toHaveLength(distortion.length);
    expect(areSame(result?.output.map, map.bytes)).toBe(true);
    expect(steps()).toEqual(['Open body.obj and ball.obj', 'Open ball.conemap']);
  });

  test('of the work on the page is no step, and its map is current', async () => {
    await drop(source, target, landmarks);
    store.dispatch({ kind: 'options', options: { ownCones: 0 } });
    const { pairs } = store.state;
    const before = steps();
    await drop(map);
    expect(steps()).toEqual(before);
    expect(store.state.pairs).toBe(pairs);
    expect(isCurrent(store.state)).toBe(true);
  });

  test('is outdated when its landmarks are taken back, and current when they are there again', async () => {
    await drop(source, target, landmarks);
    const [first] = store.state.pairs;
    store.dispatch({ kind: 'pair-deleted', id: first?.id ?? 0 });
    await drop(map);
    expect(isCurrent(store.state)).toBe(true);
    store.dispatch({ kind: 'undo' });
    expect(store.state.pairs).toHaveLength(made.report.base_domain.vertices - 1);
    expect(isCurrent(store.state)).toBe(false);
    expect(shownResult(store.state)).not.toBeNull();
    store.dispatch({ kind: 'redo' });
    expect(isCurrent(store.state)).toBe(true);
  });

  test('of a project leaves the landmarks as they are, and is outdated where they are others', async () => {
    await drop(source, target, landmarks);
    store.dispatch({ kind: 'options', options: { ownCones: 0 } });
    await maps.openOfProject(map);
    expect(isCurrent(store.state)).toBe(true);
    const [first, second] = store.state.pairs;
    store.dispatch({ kind: 'pair-deleted', id: first?.id ?? 0 });
    const { pairs } = store.state;
    await maps.openOfProject(map);
    expect(store.state.pairs).toBe(pairs);
    expect(staleness(store.state)).toMatchObject({ removed: [1], moved: [], placed: [], meshes: [], options: [] });
    expect(second?.id).toBe(pairs[0]?.id);
  });

  test('waits for its meshes, which find their sides, and opens by itself', async () => {
    await drop(map);
    expect([store.state.awaited?.name, store.state.error]).toEqual(['ball.conemap', null]);
    // The target is opened first, on an empty page.
    await drop(target);
    expect(store.state.meshes.map((mesh) => mesh?.name)).toEqual([undefined, 'body.obj']);
    expect(store.state.result).toBeNull();
    await drop(source);
    await vi.waitFor(() => {
      expect(store.state.result?.opened?.name).toBe('ball.conemap');
    });
    expect(store.state.awaited).toBeNull();
    expect(isCurrent(store.state)).toBe(true);
  });

  test('waits beside a demo, too, and until somebody leaves it', async () => {
    const demo: Demo = { id: 'x', title: 'X', sentence: 'x' };
    store.dispatch({ kind: 'mesh', side: 0, file: meshFile(target) }, { kind: 'mesh', side: 1, file: meshFile(target) }, { kind: 'demo', demo });
    await drop(map);
    expect(store.state.awaited?.name).toBe('ball.conemap');
    store.dispatch({ kind: 'map-awaited', map: null });
    await drop(source);
    expect(store.state.result).toBeNull();
  });

  test('is refused with the name of the mesh that is another one, and nothing comes', () => {
    const obj = 'v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n';
    const other = { name: 'other.obj', bytes: new TextEncoder().encode(obj) };
    expect(refusal([source, other, map], null, INITIAL)).toBe(
      'ball.conemap: the target, other.obj, is not the mesh that this map was made with (body.obj). Drop the map together with the right one.',
    );
    const file = (given: NamedBytes, side: 0 | 1): Event => ({ kind: 'mesh', side, file: meshFile(given) });
    expect(refusal([map], null, after(INITIAL, file(other, 0), file(target, 1)))).toMatch(/the source, other\.obj, is not the mesh/);
    expect(refusal([map], null, after(INITIAL, file(target, 0), file(source, 1)))).toMatch(/swap source and target first/);
    expect(refusal([map, map], null, INITIAL)).toBe('Drop one map at a time.');
  });

  test('that is damaged is refused in a sentence, and the map on the page stays', async () => {
    await drop(source, target, map);
    const { result } = store.state;
    const damaged = (change: (bytes: Uint8Array) => void): NamedBytes => {
      const bytes = map.bytes.slice();
      change(bytes);
      return { name: 'damaged.conemap', bytes };
    };
    const half = { name: 'half.conemap', bytes: map.bytes.slice(0, map.bytes.length / 2) };
    const newer = damaged((bytes) => bytes.fill(9, 8, 10));
    for (const [file, sentence] of [
      [half, /^half\.conemap: The map file, section ".*": it does not lie within the file\.$/],
      [newer, /^damaged\.conemap: The map file has version 2313, .* use a newer program\.$/],
      [damaged((bytes) => bytes.fill(0x7b, 20, 40)), /^damaged\.conemap: The map file's header/],
      // The sections after the header hold places and pieces.
      [damaged((bytes) => bytes.fill(0, bytes.length - 60_000)), /^damaged\.conemap: The map file/],
    ] as const) {
      expect(isMapFile(file)).toBe(true);
      await drop(file);
      expect(store.state.error).toMatch(sentence);
      expect(store.state.result).toBe(result);
      expect(isCurrent(store.state)).toBe(true);
    }
  });
});

test('the files of a run are made of its map file, too', () => {
  const saved = openMap(map.bytes, source.bytes, target.bytes);
  const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);
  expect(areSame(saved.file('source-with-target-texture.glb'), files.glb)).toBe(true);
  expect(text(saved.file('base-domain.obj'))).toBe(text(files.baseObj));
  const table = (bytes: Uint8Array): number[][] =>
    text(bytes)
      .trim()
      .split('\n')
      .slice(1)
      .map((line) => line.split(',').map(Number));
  const [found, wanted] = [table(saved.file('vertex-images.csv')), table(files.csv)];
  expect(found).toHaveLength(wanted.length);
  // The last three numbers are the position in space; on an edge either face may be named.
  found.forEach((row, index) => {
    row.slice(-3).forEach((x, axis) => {
      expect(x).toBeCloseTo(wanted[index]?.at(axis - 3) ?? NaN, 9);
    });
  });
  saved.free();
});

test('a report that is none is told from one', () => {
  const text = JSON.stringify(made.report);
  expect(reportIn(text)).toEqual(made.report);
  expect(reportIn(JSON.stringify({ ...made.report, more: 1 }))).toEqual(made.report);
  for (const wrong of [
    '[]',
    'null',
    '{}',
    text.slice(1),
    JSON.stringify({ ...made.report, certificate: 'yes' }),
    JSON.stringify({ ...made.report, warnings: [{ kind: 'x', sentence: {}, value: null, side: null }] }),
    text.replace(/"energy":[\d.]+/, '"energy":1e999'),
  ]) {
    expect(reportIn(wrong), wrong.slice(0, 60)).toBeNull();
  }
});

test('the names that a map gives its meshes are only text', () => {
  const head = headOf(map);
  expect(head.meshes.map(({ name }) => name)).toEqual(['ball.obj', 'body.obj']);
});
