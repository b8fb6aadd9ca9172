/** Landmark files of other programs, and meshes in several files, read by the built core. */
import { zipSync } from 'fflate';
import { beforeAll, describe, expect, test } from 'vitest';
import type { NamedBytes } from '../../www/files.ts';
import { contentOf, filesOf, formatList, landmarkFile, pairsRead, sideCalledLike, sideRead } from '../../www/landmark-files.ts';
import type { LandmarkFile } from '../../www/landmarks.ts';
import { gathered } from '../../www/mesh-sets.ts';
import type { MeshFile, State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { buildDemo, landmarkEndings } from '../../www/wasm/page.js';
import { after } from './fixtures.ts';
import { meshFile, openingOf } from './reading.ts';
import { refusal } from './refusal.ts';
import { tetrahedron } from './tetrahedron.ts';
import { startModules } from './modules.ts';

let source: MeshFile;
let target: MeshFile;
let landmarks: LandmarkFile;
let open: State;

beforeAll(() => {
  startModules();
  const demo = buildDemo('horse-cat');
  if (demo === undefined) {
    throw new Error('the demo is gone');
  }
  source = meshFile({ name: 'horse.obj', bytes: demo.source() });
  target = meshFile({ name: 'cat.obj', bytes: demo.target() });
  landmarks = { ...landmarkFile({ name: 'a.json', bytes: demo.landmarks() }), source: 'horse.obj', target: 'cat.obj' };
  open = after(INITIAL, { kind: 'mesh', side: 0, file: source }, { kind: 'mesh', side: 1, file: target });
});

function text(name: string, content: string): NamedBytes {
  return { name, bytes: new TextEncoder().encode(content) };
}

function format(id: string): ReturnType<typeof formatList>[number] {
  const found = formatList().find((candidate) => candidate.id === id);
  if (found === undefined) {
    throw new Error(`${id} is no format`);
  }
  return found;
}

describe('landmark files', () => {
  test('of every format give the landmarks back that were written', () => {
    for (const info of formatList()) {
      const files = filesOf(info, landmarks, source.mesh, target.mesh);
      const contents = files.map(contentOf);
      expect(contents, info.id).toEqual(info.id === 'conemap' ? ['pairs'] : info.holds === 'one' ? ['one', 'one'] : ['both']);
      const read = pairsRead(files, source.mesh, target.mesh);
      expect(read.file.pairs, info.id).toEqual(landmarks.pairs);
      expect(read.remarks).toEqual([]);
      expect(landmarkEndings().split(',')).toContain(`.${info.ending.split('.').at(-1) ?? ''}`);
    }
  });

  test('for one mesh go onto the side they are dropped on, or that is called like them', () => {
    const [horse, cat] = filesOf(format('fcsv'), landmarks, source.mesh, target.mesh);
    if (horse === undefined || cat === undefined) {
      throw new Error('two files were expected');
    }
    expect([horse.name, cat.name]).toEqual(['horse.fcsv', 'cat.fcsv']);
    expect(sideCalledLike(cat, ['horse.obj', 'cat.obj'])).toBe(1);
    const points = landmarks.pairs.map(([, point]) => point);
    expect(sideRead(cat, target.mesh, 1).marks.map(({ point }) => point)).toEqual(points);
    for (const [file, over] of [[cat, null], [{ ...cat, name: 'points.fcsv' }, 1]] as const) {
      const state = after(open, ...openingOf([file], over, open).events);
      expect(state.pairs.map((pair) => pair.points)).toEqual(points.map((point) => [null, point]));
    }
    // The second file completes the first, and both together are one step, in either order.
    const both = after(open, ...openingOf([cat, horse], null, open).events);
    expect(both.pairs.map((pair) => pair.points)).toEqual(landmarks.pairs);
    const one = after(open, ...openingOf([cat], null, open).events);
    const then = after(one, ...openingOf([horse], null, one).events);
    expect(then.pairs.map((pair) => pair.points)).toEqual(landmarks.pairs);
  });

  test('with entries that nothing here uses are opened, and the entries told', () => {
    const more = { ...landmarks, radius: [0.1] };
    const { events } = openingOf([text('more.json', JSON.stringify(more))], null, open);
    expect(after(open, ...events).pairs.map((pair) => pair.points)).toEqual(landmarks.pairs);
    const said = events.flatMap((event) => (event.kind === 'error' ? [event.sentence] : []));
    expect(said).toHaveLength(1);
    expect(said[0]).toMatch(/has entries that are not known and not used: "radius"/);
    const miscounted = openingOf([text('more.json', JSON.stringify({ ...more, labels: ['nose'] }))], null, open).events;
    expect(JSON.stringify(miscounted)).toMatch(/1 labels for \d+ pairs.*1 more remark/);
  });

  test('that name other meshes are opened, and the meshes told', () => {
    const remarks = (named: Partial<LandmarkFile>): string => {
      const { events } = openingOf([text('pairs.json', JSON.stringify({ ...landmarks, ...named }))], null, open);
      expect(after(open, ...events).pairs).toHaveLength(landmarks.pairs.length);
      return events.flatMap((event) => (event.kind === 'error' ? [event.sentence] : [])).join(' ');
    };
    expect(remarks({})).toBe('');
    expect(remarks({ source: 'scans/Horse.ply', target: 'cat' })).toBe('');
    expect(remarks({ source: 'scans/cow.off', target: 'lion.off' })).toMatch(/^These landmarks were made for cow\.off and lion\.off, .*or drop the meshes here\.$/);
    expect(remarks({ target: 'lion.off' })).toMatch(/^These landmarks were made for lion\.off, .*or drop the mesh here\.$/);
  });

  test('that cannot be placed are refused with what to do', () => {
    const far = text('far.csv', 'name,x,y,z\nnose,1e6,0,0\n');
    expect(refusal([far], 0, open)).toMatch(/^far\.csv: Landmark 1 \("nose"\) of the source lies .* off the surface/);
    expect(refusal([far], null, open)).toMatch(/drop the file on the view of that mesh/);
    expect(refusal([far], 0, INITIAL)).toMatch(/^far\.csv: .*load their mesh first/);
    expect(refusal([far, far, far], null, open)).toMatch(/one for each mesh/);
    expect(refusal([text('a.csv', 'name,x,y,z\nnose,one,0,0\n')], 0, open)).toBe(
      'a.csv: CSV file, line 2: "one" should be a coordinate.',
    );
    expect(refusal([text('a.json', '{"x": 1}')], null, open)).toMatch(/^a\.json: The landmark file, line 1: missing field `pairs`/);
    const nearby = text('near.csv', 'name,x,y,z\nnose,1e6,0,0\n');
    const [horse] = filesOf(format('csv'), landmarks, source.mesh, target.mesh);
    expect(horse === undefined ? '' : refusal([horse, nearby], null, open)).toMatch(/one for each mesh/);
  });
});

/** A tetrahedron in two files, where the name of the second must be escaped. */
function twoFiles(): [NamedBytes, NamedBytes] {
  const { gltf, bin } = tetrahedron('tetra%20hedron.bin');
  return [text('tetra.gltf', gltf), { name: 'tetra hedron.bin', bytes: bin }];
}

describe('meshes in several files', () => {
  test('are one file when all are there, and the missing ones are named', () => {
    const [gltf, buffer] = twoFiles();
    const state = after(INITIAL, ...openingOf([buffer, gltf], 0, INITIAL).events);
    expect([state.meshes[0]?.name, state.meshes[0]?.faceCount]).toEqual(['tetra.glb', 4]);
    expect(refusal([gltf], 0, INITIAL)).toBe('tetra.gltf: its data is in tetra hedron.bin. Drop all of these files at once.');
    expect(refusal([buffer], 0, INITIAL)).toMatch(/^tetra hedron\.bin: this is a part of a mesh/);
  });

  test('come out of a zip with their folders, materials and pictures', () => {
    const [gltf, buffer] = twoFiles();
    const bytes = zipSync({
      'model/tetra.gltf': gltf.bytes,
      'model/tetra hedron.bin': buffer.bytes,
      'model/skin.mtl': new Uint8Array(5),
      '__MACOSX/model/._tetra.gltf': new Uint8Array(5),
    });
    const state = after(INITIAL, ...openingOf([{ name: 'all.zip', bytes }], null, INITIAL).events);
    expect([state.meshes[0]?.name, state.meshes[0]?.faceCount]).toEqual(['tetra.glb', 4]);
    const cut = bytes.slice(0, bytes.length / 2);
    expect(refusal([{ name: 'all.zip', bytes: cut }], null, INITIAL)).toMatch(/^all\.zip: this zip cannot be unpacked/);
  });

  test('do not come out of a zip that unpacks to too much', () => {
    const bytes = zipSync({ 'a.obj': new Uint8Array(2 ** 25) });
    expect(bytes.length).toBeLessThan(2 ** 17);
    expect(() => gathered([{ name: 'bomb.zip', bytes }])).toThrow(/unpacks to more than the page can take/);
    const many = zipSync(Object.fromEntries(Array.from({ length: 1001 }, (_, index) => [`${index}.obj`, new Uint8Array(1)])));
    expect(() => gathered([{ name: 'many.zip', bytes: many }])).toThrow(/more than 1000 files/);
  });
});
