/** Project files: everything that is saved comes back, and damaged or hostile files are refused by name. */
import { describe, expect, test } from 'vitest';
import { PROJECT_REFUSED } from '../../../www/messages.ts';
import type { Archiver, Entries } from '../../../www/send/archive.ts';
import { isArchive, readArchive, writeArchive } from '../../../www/send/archive.ts';
import type { Project } from '../../../www/send/project.ts';
import { ProjectRefused, readProject, writeProject } from '../../../www/send/project.ts';
import { Random } from '../random.ts';
import { anyWork } from './works.ts';

const HERE: Archiver = {
  write: async (entries) => Promise.resolve(writeArchive(entries)),
  // As in a worker, errors arrive in a promise.
  read: async (bytes, names) => Promise.resolve().then(() => readArchive(bytes, names)),
};
const LANDMARKS = '{"pairs":[]}';

function anyProject(random: Random): Project {
  const mesh = (name: string): Project['meshes'][0] => ({
    name,
    bytes: random.bytes(random.below(5000)),
    address: random.of([null, 'https://data.example/cat.obj']),
    ...random.of([{}, { picture: random.bytes(50) }]),
    ...random.of([{}, { ofDemo: { id: 'horse-cat', side: random.of([0, 1] as const) } }]),
  });
  return {
    meshes: random.of([
      [mesh('same.off'), mesh('same.off')],
      [mesh('a mesh: "1" – 猫.obj'), null],
      [null, mesh('lion (mirrored).obj')],
    ]),
    work: anyWork(random),
    result: random.of([null, { map: null, report: '{}' }, { map: random.bytes(100), report: '{"energy":4.2}' }]),
  };
}

async function saved(project: Project): Promise<Uint8Array> {
  return writeProject(project, LANDMARKS, HERE);
}

const FILES = ['conemap.json', 'landmarks.json', 'map.conemap', 'report.json', 'source/cat.off', 'target/lion.off'];
const CAT_LION: Project = {
  meshes: [
    { name: 'cat.off', bytes: new TextEncoder().encode('OFF\n'), address: null },
    { name: 'lion.off', bytes: new TextEncoder().encode('OFF lion\n'), address: null },
  ],
  work: { ...anyWork(new Random(21)), pairs: [{ number: 1, points: [1, 2], label: 'nose', locked: false }] },
  result: { map: new Uint8Array([1, 2, 3]), report: '{}' },
};

/** The result of reading the project of cat and lion after a change of its files. */
async function changed(change: (entries: Record<string, Uint8Array>) => void): Promise<unknown> {
  const entries = { ...readArchive(await saved(CAT_LION), FILES) };
  change(entries);
  return readProject(writeArchive(entries), HERE).catch((thrown: unknown) => (thrown instanceof ProjectRefused ? thrown.fault : thrown));
}

/** A change of the manifest. */
function withManifest(change: (manifest: Record<string, unknown>) => unknown): (entries: Record<string, Uint8Array>) => void {
  return (entries) => {
    const manifest = JSON.parse(new TextDecoder().decode(entries['conemap.json'])) as Record<string, unknown>;
    entries['conemap.json'] = new TextEncoder().encode(JSON.stringify(change(manifest)));
  };
}

describe('a project file', () => {
  test('gives back all that was saved', { timeout: 60_000 }, async () => {
    const random = new Random(22);
    for (let round = 0; round < 40; round++) {
      const project = anyProject(random);
      const bytes = await saved(project);
      expect(isArchive(bytes)).toBe(true);
      expect(await saved(project)).toEqual(bytes);
      expect(await readProject(bytes, HERE)).toEqual(project);
    }
  });

  test('holds the meshes as they were given, and landmarks that other programs read', async () => {
    const entries: Entries = readArchive(await saved(CAT_LION), FILES);
    expect(Object.keys(entries).sort()).toEqual(FILES);
    expect(entries['source/cat.off']).toEqual(CAT_LION.meshes[0]?.bytes);
    expect(new TextDecoder().decode(entries['landmarks.json'])).toBe(LANDMARKS);
  });

  test('names its files so that every system can unpack them', async () => {
    const name = '../../etc/a:b*c?"<d>|\u202e.off';
    const project: Project = { ...CAT_LION, meshes: [{ name, bytes: new Uint8Array(3), address: null }, null], result: null };
    const bytes = await saved(project);
    expect(Object.keys(readArchive(bytes, ['source/a_b_c___d__.off']))).toHaveLength(1);
    expect((await readProject(bytes, HERE)).meshes[0]?.name).toBe('a:b*c?"<d>|.off');
  });
});

describe('a project file that is none or was changed', () => {
  test('is refused with its reason', async () => {
    const read = async (bytes: Uint8Array): Promise<unknown> =>
      readProject(bytes, HERE).catch((thrown: unknown) => (thrown instanceof ProjectRefused ? thrown.fault : thrown));
    expect(await read(new TextEncoder().encode('PK no archive'))).toBe('no-archive');
    expect(await read(writeArchive({ 'cat.obj': new Uint8Array(3) }))).toBe('no-project');
    expect(await changed((entries) => (entries['conemap.json'] = new TextEncoder().encode('{')))).toBe('damaged');
    expect(await changed(withManifest((manifest) => ({ ...manifest, format: 'other' })))).toBe('no-project');
    expect(await changed(withManifest((manifest) => ({ ...manifest, version: 2, work: 'later' })))).toBe('newer');
    expect(await changed(withManifest((manifest) => ({ ...manifest, work: {} })))).toBe('damaged');
    expect(await changed(withManifest((manifest) => ({ ...manifest, meshes: [{ name: 'a', entry: '../a', hash: null, address: null }, null] })))).toBe('damaged');
    expect(await changed((entries) => delete entries['target/lion.off'])).toBe('mesh-missing');
    expect(await changed((entries) => (entries['target/lion.off'] = new TextEncoder().encode('OFF cat\n')))).toBe('mesh-changed');
    expect(await changed((entries) => (entries['conemap.json'] = new TextEncoder().encode(`"${' '.repeat(5_000_000)}"`)))).toBe('damaged');
    for (const sentence of Object.values(PROJECT_REFUSED)) {
      expect(sentence).toMatch(/^(?:this|a) .*\.$/);
    }
  });

  test('opens without what a result lacks, and with more than this page knows', async () => {
    expect(await changed((entries) => delete entries['report.json'])).toEqual({ ...CAT_LION, result: null });
    expect(await changed((entries) => delete entries['map.conemap'])).toEqual({ ...CAT_LION, result: { map: null, report: '{}' } });
    expect(await changed(withManifest((manifest) => ({ ...manifest, later: 1 })))).toEqual(CAT_LION);
  });

  test('is refused where the demo of a mesh is none', async () => {
    const ofDemo = (given: unknown) => (manifest: Record<string, unknown>) => {
      const [source, target] = manifest['meshes'] as [object, object];
      return { ...manifest, meshes: [{ ...source, ofDemo: given }, target] };
    };
    for (const given of [null, 'horse-cat', {}, { id: 'horse-cat' }, { id: '', side: 0 }, { id: 7, side: 0 }, { id: 'a', side: 2 }, { id: 'a', side: '0' }]) {
      expect(await changed(withManifest(ofDemo(given)))).toBe('damaged');
    }
    expect(await changed(withManifest(ofDemo({ id: 'a'.repeat(20_000), side: 0 })))).toBe('damaged');
    const opened = (await changed(withManifest(ofDemo({ id: 'a', side: 1, more: 'b' })))) as Project;
    expect(opened.meshes.map((mesh) => mesh?.ofDemo)).toEqual([{ id: 'a', side: 1 }, undefined]);
  });

  test('asks no other way for its meshes than https', async () => {
    const meshes = (address: string) => (manifest: Record<string, unknown>) => {
      const [source, target] = manifest['meshes'] as [object, object];
      return { ...manifest, meshes: [{ ...source, address }, target] };
    };
    for (const address of ['http://a.b/c', 'javascript:alert(1)', 'https://a:b@c.d/', '']) {
      expect(await changed(withManifest(meshes(address))), address).toEqual(CAT_LION);
    }
  });
});
