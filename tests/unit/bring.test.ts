/** Files that are brought across: what they may be taken for, the requests to the core, and answers that come late. */
import { afterEach, beforeAll, beforeEach, describe, expect, test, vi } from 'vitest';
import type { Choices, DeskState, MadeFile } from '../../www/bring/desk.ts';
import { Desk, wishOf } from '../../www/bring/desk.ts';
import type { BringMessage, BringRequest, GivenFileReport } from '../../www/bring/messages.ts';
import { separatorFault } from '../../www/bring/separators.ts';
import { bringSentence, hindrance, kindSentence, savedSentence, WORDS } from '../../www/bring/words.ts';
import type { Result } from '../../www/store/state.ts';
import { givenFile } from '../../www/wasm/core.js';
import type { FakeWorker } from './fake-worker.ts';
import { fakeWorkers } from './fake-worker.ts';
import { mesh, RESULT } from './fixtures.ts';
import { startCoreModule } from './modules.ts';

const MODULE = {} as WebAssembly.Module;
const MAP: Result = {
  ...RESULT,
  output: { ...RESULT.output, map: new Uint8Array([1]) },
  inputs: { ...RESULT.inputs, meshes: [mesh('cat.obj'), mesh('lion.obj')] },
};

const VALUES: GivenFileReport = { kinds: ['values', 'curves'], columns: ['heat', 'part'] };
const CURVES: GivenFileReport = { kinds: ['curves', 'frames'], columns: [] };
const FRAME: GivenFileReport = { kinds: ['frames'], columns: [] };

function file(name: string, size = 1): File {
  return Object.defineProperty(new File(['x'], name), 'size', { value: size });
}

let workers = fakeWorkers<BringMessage>();
let shown: Result | null = MAP;
let core: WebAssembly.Module | null = MODULE;
let saved: MadeFile[] = [];
let desk: Desk;

beforeEach(() => {
  workers = fakeWorkers<BringMessage>();
  vi.stubGlobal('Worker', workers);
  vi.spyOn(console, 'error').mockImplementation(() => undefined);
  [shown, core, saved] = [MAP, MODULE, []];
  desk = new Desk({
    core: () => core,
    shown: () => shown,
    save: (made) => {
      saved.push(made);
    },
  });
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

function worker(): FakeWorker<BringMessage> {
  const last = workers.made.at(-1);
  if (last === undefined) {
    throw new Error('no worker was started');
  }
  return last;
}

function asked(): BringRequest {
  return worker().posted.at(-1) as BringRequest;
}

function taken(reports: readonly GivenFileReport[], ...names: readonly string[]): DeskState {
  desk.take(names.map((name) => file(name)));
  worker().says({ kind: 'done', answer: reports });
  return desk.state;
}

function came(only: string | null, count = 1, remark: string | null = null): void {
  worker().says({ kind: 'done', answer: { only, bytes: new Uint8Array([7]), count, remark } });
}

describe('files that were chosen', () => {
  test('are taken for what they are likeliest, and for something else when asked', () => {
    const { given, choices } = taken([VALUES], 'heat.PLY');
    expect(given).toMatchObject({ kind: 'values', kinds: ['values', 'curves'], columns: ['heat', 'part'] });
    expect(choices).toMatchObject({ from: 'target', valueFormat: 'ply' });
    desk.takeFor('curves');
    expect(desk.state.given?.kind).toBe('curves');
    desk.takeFor('frames');
    expect(desk.state.given?.kind).toBe('curves');
    expect(asked()).toMatchObject({ kind: 'look', module: MODULE });
  });

  test('are poses where there are several', () => {
    expect(taken([FRAME, CURVES], 'a.obj', 'b.obj').given).toMatchObject({ kind: 'frames', kinds: ['frames'] });
    const { given, error } = taken([FRAME, VALUES], 'a.obj', 'heat.csv');
    expect(error).toBe('heat.csv: several files at once must be one mesh in several poses, and this is none. Bring it alone.');
    expect(given).toBeNull();
  });

  test('are refused by name, and then nothing is chosen', () => {
    taken([VALUES], 'heat.csv');
    desk.take([file('empty.csv')]);
    expect(desk.state.work).toEqual({ kind: 'looking', share: 0 });
    worker().says({ kind: 'failed', failure: { code: 'transfer', message: 'the file is empty', file: 0 } });
    expect(desk.state).toMatchObject({ error: 'empty.csv: The file is empty.', work: null, given: null, made: null });
    const before = workers.made.length;
    desk.bring();
    expect(workers.made).toHaveLength(before);
    taken([VALUES], 'heat.csv');
    desk.take([file('huge.obj', 2 ** 30 + 1)]);
    expect(desk.state.given).toBeNull();
    expect(desk.state.error).toBe('huge.obj is larger than 1 GiB, more than the page can take.');
    desk.take([file('a.obj', 2 ** 29), file('b.obj', 2 ** 29 + 1)]);
    expect(desk.state).toMatchObject({ error: WORDS.tooMuch, given: null });
    taken([VALUES], 'heat.csv');
    core = null;
    desk.take([file('heat.csv')]);
    expect(desk.state).toMatchObject({ error: WORDS.noCore, work: null, given: { kind: 'values' } });
  });

  test('are refused where they are a folder', () => {
    taken([VALUES], 'heat.csv');
    desk.refuseFolder('poses');
    expect(desk.state).toMatchObject({ error: 'poses is a folder: drop the files that are in it.', work: null, given: null });
  });

  test('of which the later ones count, whatever comes of the earlier', () => {
    desk.take([file('a.csv')]);
    const first = worker();
    desk.take([file('b.obj')]);
    expect(first.ended).toBe(true);
    first.says({ kind: 'done', answer: [VALUES] });
    expect(desk.state.given).toBeNull();
    worker().says({ kind: 'done', answer: [FRAME] });
    expect(desk.state.given?.kind).toBe('frames');
  });

  test('keep what was said of their columns as long as they have the same', () => {
    taken([VALUES], 'heat.csv');
    desk.choose({ columns: 'own', roles: new Map([['part', 'labels']]) });
    expect(taken([VALUES], 'heat-2.csv').choices).toMatchObject({ columns: 'own', roles: new Map([['part', 'labels']]) });
    expect(taken([{ ...VALUES, columns: ['bone'] }], 'skin.csv').choices).toMatchObject({ columns: 'numbers', roles: new Map() });
  });
});

describe('what is asked for', () => {
  test('follows the choices', () => {
    const { choices } = desk.state;
    const own: Choices = { ...choices, columns: 'own', roles: new Map([['part', 'labels'], ['left', 'weights']]) };
    const columns = ['heat', 'part', 'left'];
    expect(wishOf({ kind: 'values', columns }, own)).toEqual({
      from: 'target',
      what: { kind: 'values', method: 'projection', labels: ['part'], weights: ['left'], format: 'csv' },
    });
    expect(wishOf({ kind: 'values', columns }, { ...choices, columns: 'weights', from: 'source', method: 'mean' })).toEqual({
      from: 'source',
      what: { kind: 'values', method: 'mean', labels: [], weights: columns, format: 'csv' },
    });
    expect(wishOf({ kind: 'curves', columns: [] }, choices).what).toEqual({ kind: 'curves', format: 'json' });
    expect(wishOf({ kind: 'texture', columns: [] }, choices).what).toEqual({ kind: 'texture', size: 1024 });
    expect(wishOf({ kind: 'frames', columns: [] }, choices).what).toEqual({ kind: 'frames' });
  });

  test('is saved when it comes, and again when asked', () => {
    taken([VALUES], 'heat.csv');
    desk.bring();
    expect(asked()).toMatchObject({ kind: 'bring', map: new Uint8Array([1]), wish: { from: 'target' } });
    worker().says({ kind: 'progress', share: 0.5 });
    expect(desk.state.work).toEqual({ kind: 'bringing', share: 0.5 });
    came('values.csv', 1, 'lists are left out: bones');
    expect(desk.state).toMatchObject({ work: null, error: null });
    expect(saved).toMatchObject([{ name: 'heat-on-source.csv', sentence: 'Saved as heat-on-source.csv. Lists are left out: bones.' }]);
    desk.saveAgain();
    expect(saved).toHaveLength(2);
    expect(worker().ended).toBe(true);
  });

  test('is an archive where there are several files', () => {
    taken([FRAME, FRAME], 'walk-1.obj', 'walk-2.obj');
    desk.choose({ from: 'source' });
    desk.bring();
    came(null, 2);
    expect(saved[0]).toMatchObject({ name: 'walk-1-and-others-on-target.zip', sentence: '2 files saved as walk-1-and-others-on-target.zip.' });
    desk.bringShapes();
    expect(asked()).toMatchObject({ files: [], wish: { what: { kind: 'shapes' } } });
    came(null, 3);
    expect(saved[1]?.name).toBe('shapes.zip');
  });

  test('is left when the user has had enough; files and choices stay', () => {
    taken([CURVES], 'belt.obj');
    desk.choose({ curveFormat: 'obj' });
    desk.bring();
    desk.cancel();
    expect(worker().ended).toBe(true);
    came('curves.obj');
    expect(saved).toEqual([]);
    expect(desk.state).toMatchObject({ work: null, error: null, given: { kind: 'curves' }, choices: { curveFormat: 'obj' } });
  });

  test('is left out when the map is another one by then', () => {
    taken([CURVES], 'belt.obj');
    desk.bring();
    shown = { ...MAP };
    came('curves.json');
    expect(saved).toEqual([]);
    expect(desk.state).toMatchObject({ work: null, error: WORDS.mapChanged, given: { kind: 'curves' } });
    desk.bring();
    shown = null;
    desk.follow();
    expect(worker().ended).toBe(true);
    expect(desk.state.error).toBe(WORDS.mapChanged);
  });

  test('fails with the name of the file at fault', () => {
    taken([VALUES], 'heat.csv');
    desk.bring();
    worker().says({ kind: 'failed', failure: { code: 'transfer', message: 'line 2: "warm" should be a number of "heat"', file: 0 } });
    expect(desk.state.error).toBe('heat.csv: Line 2: "warm" should be a number of "heat".');
    desk.bring();
    worker().says({ kind: 'failed', failure: { code: 'transfer', message: 'line 9: the corner 1 has no texture coordinates', file: 'source' } });
    expect(desk.state).toMatchObject({ error: 'cat.obj: Line 9: the corner 1 has no texture coordinates.', given: { kind: 'values' } });
    expect(bringSentence({ code: 'transfer', message: 'it ended', file: null }, [], { source: 'a', target: 'b' })).toBe('It ended.');
  });
});

test('why nothing can be brought across is said in a sentence', () => {
  const bare = { ...MAP, output: { ...MAP.output, map: null } };
  expect([hindrance(null, null), hindrance(MAP, null), hindrance(bare, bare), hindrance(MAP, MAP)]).toEqual([
    WORDS.noMap,
    WORDS.otherMeshes,
    WORDS.noMapFile,
    null,
  ]);
});

test('what files are taken for is said in a sentence', () => {
  expect(kindSentence(['heat.csv'], 'values', ['heat'], 'target')).toBe('heat.csv: values of the target’s vertices, 1 column (heat).');
  expect(kindSentence(['skin.csv'], 'values', Array.from('abcdefgh'), 'source')).toContain('8 columns (a, b, c, d, e, f and 2 more)');
  expect(kindSentence(['belt.obj'], 'curves', [], 'source')).toBe('belt.obj: curves on the source.');
  expect(kindSentence(['skin.png'], 'texture', [], 'target')).toContain('over the source’s own texture coordinates');
  expect(kindSentence(['a.obj', 'b.obj'], 'frames', [], 'target')).toBe('2 files: the target in other poses. The source moves in the same way.');
  expect(savedSentence('a.csv', 1)).toBe('Saved as a.csv.');
});

describe('the core', () => {
  beforeAll(startCoreModule);

  const told = (content: string): GivenFileReport => JSON.parse(givenFile(new TextEncoder().encode(content))) as GivenFileReport;

  test('does not read tables without commas, and the page says what to do', () => {
    const fault = (content: string): string | null => separatorFault(new TextEncoder().encode(content));
    for (const content of ['vertex;heat;part\r\n0;1,5;2\r\n', '0;1.5\n1;2.5\n']) {
      expect(() => told(content)).toThrow();
      expect(fault(content)).toBe('its columns are separated by semicolons: save the table with commas between the columns, and with points in the numbers');
    }
    expect(fault('vertex\theat\n0\t1\n')).toContain('tabs');
    expect(fault('Dear reader; hello\nsome words\n')).toBeNull();
    expect(fault('\u0000;\n')).toBeNull();
  });

  test('tells by its content what a file may hold', () => {
    expect(told('vertex,heat,part\n0,1,2\n')).toEqual(VALUES);
    expect(told('v 0 0 0\nf 1 1 1\nl 1 1\n')).toEqual(CURVES);
    expect(told('v 0 0 0\nf 1 1 1\n')).toEqual(FRAME);
    expect(told('{"curves": []}').kinds).toEqual(['curves']);
    const refusal = (content: string): string => {
      try {
        return JSON.stringify(told(content));
      } catch (thrown) {
        return String(thrown);
      }
    };
    expect(refusal('')).toContain('the file is empty');
    expect(refusal('Dear reader\nsome words\n')).toContain('nothing in it can be brought across');
  });
});
