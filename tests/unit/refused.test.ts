/** Refused meshes, the repairs that are offered, and their results. */
import { beforeAll, expect, test, vi } from 'vitest';
import { freeExamined } from '../../www/app/repair-mesh.ts';
import type { NamedBytes } from '../../www/files.ts';
import { repairCommand } from '../../www/messages.ts';
import type { Report } from '../../www/report.ts';
import { shownDefects } from '../../www/store/defects.ts';
import { NO_HISTORY } from '../../www/store/history.ts';
import { ALL_ALLOWED, allowedBy } from '../../www/store/refused.ts';
import type { RefusedMesh } from '../../www/store/refused.ts';
import type { State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { workOf } from '../../www/store/work.ts';
import { runMap } from '../../www/wasm/core.js';
import { after, mesh, READY } from './fixtures.ts';
import { eventsOfSides, examinedRepair, meshFile, openingOf, repairedEvents } from './reading.ts';
import { startCoreModule, startModules } from './modules.ts';

beforeAll(() => {
  startCoreModule();
  startModules();
});

/** Vertices and faces; the faces number the vertices from 0. */
interface Shape {
  readonly vertices: readonly (readonly number[])[];
  readonly faces: readonly (readonly number[])[];
}

const CORNER: Shape = {
  vertices: [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]],
  faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
};

/** A ring with one handle. */
function ring(around: number, tube: number): Shape {
  const vertices: number[][] = [];
  const faces: number[][] = [];
  const at = (i: number, j: number): number => (i % around) * tube + (j % tube);
  for (let i = 0; i < around; i++) {
    for (let j = 0; j < tube; j++) {
      const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / tube];
      const out = 2 + Math.cos(b);
      vertices.push([out * Math.cos(a), out * Math.sin(a), Math.sin(b)]);
      faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  }
  return { vertices, faces };
}

function beside(one: Shape, other: Shape, x: number): Shape {
  const first = one.vertices.length;
  return {
    vertices: [...one.vertices, ...other.vertices.map(([p = 0, ...rest]) => [p + x, ...rest])],
    faces: [...one.faces, ...other.faces.map((face) => face.map((v) => v + first))],
  };
}

function obj(name: string, { vertices, faces }: Shape): NamedBytes {
  const lines = [...vertices.map((v) => `v ${v.join(' ')}`), ...faces.map((f) => `f ${f.map((v) => v + 1).join(' ')}`)];
  return { name, bytes: new TextEncoder().encode(`${lines.join('\n')}\n`) };
}

function landmarks(pairs: readonly (readonly number[])[], names: object = {}): NamedBytes {
  return { name: 'pairs.json', bytes: new TextEncoder().encode(JSON.stringify({ pairs, ...names })) };
}

const GOOD = obj('corner.obj', CORNER);
const RING = obj('ring.obj', ring(12, 8));
const EMPTY: State = { ...INITIAL, ready: true };

function refusedIn(state: State, place = 0): RefusedMesh {
  const mesh = state.refused?.meshes[place];
  if (mesh === undefined) {
    throw new Error('nothing is refused');
  }
  return mesh;
}

/** The label of the button that repairs a refused mesh; `null` for none. */
function command({ offer }: RefusedMesh): string | null {
  return offer === null ? null : repairCommand(offer);
}

test('a good mesh that comes with a bad one stays, and the bad one waits with its repair', () => {
  const state = after(EMPTY, ...openingOf([GOOD, RING], null, EMPTY).events);
  expect(state.meshes[0]?.name).toBe('corner.obj');
  expect(state.meshes[1]).toBeNull();
  expect(state.error).toBeNull();
  const refused = refusedIn(state);
  expect(refused).toMatchObject({ side: 1, offer: { kind: 'cut-handles', handles: 1 } });
  expect(refused.sentence).toMatch(/^ring\.obj: The surface has 1 handle \(at vertex \d+ a loop of 8 edges, /);
  expect(refused.sentence).not.toContain('--');
  expect(command(refused)).toBe('Cut 1 handle and cap it');

  const repaired = after(state, ...repairedEvents(refused, state));
  expect(repaired.meshes.map((file) => file?.name)).toEqual(['corner.obj', 'ring.obj']);
  expect(repaired.meshes[1]?.repairs).toMatch(/^1 handle was cut and closed \(/);
  expect(repaired.refused).toBeNull();
  expect(repaired.toast).toMatchObject({ undo: true });
  expect(repaired.toast?.sentence).toMatch(/^ring\.obj: 1 handle was cut and closed/);
  const back = after(repaired, { kind: 'undo' });
  expect(back.meshes.map((file) => file?.name ?? null)).toEqual(['corner.obj', null]);
  expect(after(back, { kind: 'redo' }).meshes[1]).toBe(repaired.meshes[1]);
  // A repair that was accepted once is made again when the mesh is read.
  expect(meshFile(RING, ALL_ALLOWED).faceCount).toBe(repaired.meshes[1]?.faceCount);
});

test('one repair may lead to the next, and allows no more than was asked for', () => {
  const both = obj('both.obj', beside(ring(12, 8), CORNER, 9));
  const state = after(EMPTY, ...openingOf([both], 1, EMPTY).events);
  const first = refusedIn(state);
  expect(first.offer).toMatchObject({ kind: 'keep-largest', parts: 2 });
  expect(command(first)).toMatch(/^Keep the largest part \(7\d % of the area\)$/);
  const next = after(state, ...repairedEvents(first, state));
  expect(next.meshes[1]).toBeNull();
  const second = refusedIn(next);
  expect(second).toMatchObject({ side: 1, allowed: { parts: 'largest-alone' }, offer: { kind: 'cut-handles' } });
  const repaired = after(next, ...repairedEvents(second, next));
  expect(repaired.meshes[1]?.repairs).toMatch(/1 loose part was dropped.*1 handle was cut and closed/);
  expect(repaired.refused).toBeNull();
});

test('landmarks wait for the last of the meshes that they came with', () => {
  const pairs = landmarks([[0, 0], [1, 10], [2, 20], [3, 30]], { source: 'corner.obj', target: 'ring.obj' });
  // The pairs would not fit the mesh that was there before.
  const given = after(READY, { kind: 'pairs-cleared' });
  const state = after(given, ...openingOf([GOOD, RING, pairs], null, given).events);
  expect(state.error).toBeNull();
  expect(state.pairs).toEqual([]);
  const repaired = after(state, ...repairedEvents(refusedIn(state), state));
  expect(repaired.pairs).toHaveLength(4);
  expect(repaired.error).toBeNull();

  const two = after(EMPTY, ...openingOf([RING, obj('other.obj', ring(9, 6)), landmarks([[0, 0], [1, 1], [2, 2], [3, 3]])], null, EMPTY).events);
  const half = after(two, ...repairedEvents(refusedIn(two, 0), two));
  expect([half.pairs.length, half.refused?.meshes.length]).toEqual([0, 1]);
  const whole = after(half, ...repairedEvents(refusedIn(half), half));
  expect([whole.pairs.length, whole.refused]).toEqual([4, null]);
});

test('landmarks that do not fit a repaired mesh are told, and the mesh stays', () => {
  const state = after(EMPTY, ...openingOf([GOOD, RING, landmarks([[0, 0], [1, 1], [2, 2], [9, 3]])], null, EMPTY).events);
  const repaired = after(state, ...repairedEvents(refusedIn(state), state));
  expect(repaired.meshes[1]?.name).toBe('ring.obj');
  expect(repaired.pairs).toEqual([]);
  expect(repaired.error).toMatch(/^Pairs\.json|^pairs\.json/);
});

test('a mesh that no repair helps is shown beside a good one, which stays', () => {
  const sheet = obj('sheet.obj', { vertices: CORNER.vertices, faces: CORNER.faces.slice(0, 1) });
  const state = after(EMPTY, ...openingOf([GOOD, sheet], null, EMPTY).events);
  expect(state.meshes[0]?.name).toBe('corner.obj');
  expect(state.error).toBeNull();
  const refused = refusedIn(state);
  expect(refused).toMatchObject({ side: 1, offer: null });
  expect(refused.sentence).toMatch(/^sheet\.obj: The surface is an open sheet/);
  expect(allowedBy(refused)).toEqual({});
  expect(refused.examined.groups.map(({ sentence }) => sentence)).toEqual(['1 open rim']);
  expect(refused.examined.groups[0]?.labels).toEqual(['3 edges from vertex 0 on']);
});

test('a file without a mesh is told, and there is nothing to show of it', () => {
  const points = obj('points.obj', { vertices: CORNER.vertices, faces: [] });
  const state = after(EMPTY, ...openingOf([GOOD, points, landmarks([[0, 0]])], null, EMPTY).events);
  expect(state.meshes[0]?.name).toBe('corner.obj');
  expect(state.refused).toBeNull();
  expect(state.error).toMatch(/^points\.obj: .*The landmarks were left out/);
  expect(() => openingOf([points], null, EMPTY)).toThrow(/^points\.obj: /);
  const others = obj('others.obj', { vertices: CORNER.vertices, faces: [] });
  expect(() => openingOf([points, others], null, EMPTY)).toThrow(/^points\.obj: .* others\.obj: /);
});

test('what is wrong with a refused mesh is told by kind and place, and given back with it', () => {
  const both = obj('both.obj', beside(ring(12, 8), CORNER, 9));
  const state = after(EMPTY, ...openingOf([both], 1, EMPTY).events);
  const { examined } = refusedIn(state);
  expect(examined.groups.map(({ kind, sentence, labels }) => [kind, sentence, labels])).toEqual([
    ['loose_part', '1 part beside the largest', ['4 faces from face 192 on']],
    ['handle_loop', '1 handle', [expect.stringMatching(/^8 edges from vertex \d+ on$/)]],
  ]);
  const looks = examined.groups.map(({ colour, stroke, fill }) => [colour, stroke, fill]);
  expect(looks).toEqual([[expect.stringMatching(/^#[0-9a-f]{6}$/), null, 'grid'], [expect.stringMatching(/^#/), 'dash-dot', null]]);
  expect([shownDefects(state, 0), shownDefects(state, 1)]).toEqual([null, examined]);

  const free = vi.spyOn(examined.found, 'free');
  const next = after(state, ...repairedEvents(refusedIn(state), state));
  freeExamined(next, state);
  expect(free).toHaveBeenCalledTimes(1);
});

test('where a mesh was repaired is shown when asked, and goes with the mesh', () => {
  const state = after(EMPTY, ...openingOf([RING], 1, EMPTY).events);
  const repaired = after(state, ...repairedEvents(refusedIn(state), state));
  const file = repaired.meshes[1];
  if (file === null) {
    throw new Error('the ring is not there');
  }
  const examined = examinedRepair(file);
  expect(examined.groups.map(({ sentence }) => sentence)).toEqual(['1 handle', '2 caps']);
  const shown = after(repaired, { kind: 'examined', side: 1, examined });
  expect(shownDefects(shown, 1)).toBe(examined);
  expect(after(shown, { kind: 'swap-meshes' }).examined).toEqual([examined, null]);
  expect(after(shown, { kind: 'undo' }).examined).toEqual([null, null]);
});

test('a mesh that was refused is left out when something else comes there, or when nobody wants it', () => {
  const state = after(EMPTY, ...openingOf([RING], 1, EMPTY).events);
  expect(after(state, { kind: 'mesh', side: 0, file: mesh('cat.off') }).refused).toBe(state.refused);
  expect(after(state, { kind: 'mesh', side: 1, file: mesh('cat.off') }).refused).toBeNull();
  expect(after(state, { kind: 'refused-closed', side: 0 }).refused).toBe(state.refused);
  expect(after(state, { kind: 'refused-closed', side: 1 }).refused).toBeNull();
  const restored = after(state, { kind: 'restored', work: workOf(READY), history: NO_HISTORY, ui: {}, hadMap: false });
  expect([restored.meshes, restored.refused]).toEqual([READY.meshes, null]);
});

test('meshes of a link wait likewise, each for its side, with the pairs for both', () => {
  const pairs = landmarks([[0, 0], [10, 1], [20, 2], [30, 3]]);
  const state = after(EMPTY, ...eventsOfSides([RING, GOOD], pairs, EMPTY));
  expect(state.meshes.map((file) => file?.name ?? null)).toEqual([null, 'corner.obj']);
  const repaired = after(state, ...repairedEvents(refusedIn(state), state));
  expect(repaired.meshes.map((file) => file?.name)).toEqual(['ring.obj', 'corner.obj']);
  expect(repaired.pairs).toHaveLength(4);
  const alone = after(EMPTY, ...eventsOfSides([null, GOOD], null, EMPTY));
  expect(alone.meshes.map((file) => file?.name ?? null)).toEqual([null, 'corner.obj']);
});

test('a run repairs a mesh as it was accepted, whatever that took', () => {
  const both = obj('both.obj', beside(ring(12, 8), CORNER, 9)).bytes;
  const pairs = JSON.stringify({ pairs: [8, 20, 44, 62, 85].map((v) => [v, v]) });
  const output = runMap(both, RING.bytes, pairs, JSON.stringify(INITIAL.options), {
    progress: () => undefined,
    relaxes: () => undefined,
    preview: () => undefined,
    found: () => undefined,
    wantsResult: () => false,
  });
  const report = JSON.parse(output.report()) as Report;
  output.free();
  expect(report.certificate).toMatchObject({ bijective: true, flipped_triangles: 0 });
  expect(report.warnings.filter(({ kind }) => kind === 'repaired').map(({ sentence }) => sentence)).toEqual([
    expect.stringMatching(/source .*1 loose part was dropped.*1 handle was cut/),
    expect.stringMatching(/target .*1 handle was cut/),
  ]);
}, 60_000);
