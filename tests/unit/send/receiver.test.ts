/** Links that are received: nothing is fetched unasked, and files given by hand are recognised. */
import { afterEach, describe, expect, test, vi } from 'vitest';
import { hashOf } from '../../../www/send/hash.ts';
import type { Link, LinkedFile } from '../../../www/send/link.ts';
import type { Delivery } from '../../../www/send/receiver.ts';
import { foreignFiles, Receiver } from '../../../www/send/receiver.ts';
import type { Receiving } from '../../../www/store/receiving.ts';
import { addressFile } from './works.ts';

const CAT = addressFile('https://data.example/cat.obj');
const LION = addressFile('https://data.example/lion.obj');
const ELSEWHERE = addressFile('https://other.example/lion.obj');
const OWN: LinkedFile = { kind: 'address', address: { url: 'https://maps.example/own.obj', name: 'own.obj', host: null } };
const PAIRS = { url: 'https://data.example/pairs.json', name: 'pairs.json', host: 'data.example' };

function bytes(text: string): Uint8Array {
  return new TextEncoder().encode(text);
}

async function local(name: string, content: string): Promise<LinkedFile> {
  return { kind: 'local', name, hash: (await hashOf(bytes(content))) ?? '' };
}

function link(source: LinkedFile | null, target: LinkedFile | null, landmarks: Link['landmarks'] = null): Link {
  return { demo: null, files: [source, target], landmarks, work: null };
}

/** A receiver, with records of everything that it reports. */
function listened(): { receiver: Receiver; said: Receiving[]; delivered: Delivery[]; failed: string[] } {
  const said: Receiving[] = [];
  const delivered: Delivery[] = [];
  const failed: string[] = [];
  const receiver = new Receiver({
    changed: (receiving) => said.push(receiving),
    delivered: (delivery) => delivered.push(delivery),
    failed: (fault, { name }) => failed.push(`${name} ${fault.kind}`),
  });
  return { receiver, said, delivered, failed };
}

/** A network on which every address gives its own text, with a record of the requests. */
function net(answer: (url: string) => Response | Promise<Response> = (url) => new Response(`bytes of ${url}`)): string[] {
  const asked: string[] = [];
  vi.stubGlobal('fetch', async (url: string) => {
    asked.push(url);
    return answer(url);
  });
  return asked;
}

async function settled(): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, 20));
}

afterEach(() => {
  vi.unstubAllGlobals();
});

describe('a link to another host', () => {
  test('waits for a click that names it, then fetches each file once', async () => {
    const asked = net();
    const { receiver, said, delivered } = listened();
    receiver.receive(link(CAT, CAT, PAIRS));
    await settled();
    expect(asked).toEqual([]);
    expect(said).toEqual([{ kind: 'click', hosts: [{ host: 'data.example', names: ['cat.obj', 'pairs.json'] }] }]);
    receiver.accept();
    await settled();
    expect(asked).toEqual(['https://data.example/cat.obj', 'https://data.example/pairs.json']);
    expect(said.at(-1)).toEqual({ kind: 'nothing' });
    expect(delivered.map(({ meshes, landmarks }) => [...meshes, landmarks].map((file) => file?.name))).toEqual([
      ['cat.obj', 'cat.obj', 'pairs.json'],
    ]);
    expect(delivered[0]?.meshes[0]?.bytes).toEqual(bytes('bytes of https://data.example/cat.obj'));
    expect(delivered[0]?.meshes[0]?.address?.url).toBe('https://data.example/cat.obj');
  });

  test('names every host', () => {
    expect(foreignFiles(link(CAT, ELSEWHERE))).toEqual([
      { host: 'data.example', names: ['cat.obj'] },
      { host: 'other.example', names: ['lion.obj'] },
    ]);
    expect(foreignFiles(link(OWN, null))).toEqual([]);
  });

  test('fetches nothing after a no, and nothing more after a cancel', async () => {
    const asked = net();
    const { receiver, said, delivered } = listened();
    receiver.receive(link(CAT, LION));
    receiver.cancel();
    receiver.accept();
    await settled();
    expect([asked, delivered]).toEqual([[], []]);
    receiver.receive(link(CAT, LION));
    receiver.accept();
    receiver.cancel();
    await settled();
    expect(asked).toEqual(['https://data.example/cat.obj']);
    expect(delivered).toEqual([]);
    expect(said.at(-1)).toEqual({ kind: 'nothing' });
  });

  test('that fails says which file, once, and waits for nothing', async () => {
    net((url) => (url.endsWith('lion.obj') ? new Response('', { status: 404 }) : new Response('OFF')));
    const { receiver, said, delivered, failed } = listened();
    receiver.receive(link(CAT, LION));
    receiver.accept();
    await settled();
    expect(failed).toEqual(['lion.obj status']);
    expect(delivered).toEqual([]);
    expect(said.at(-1)).toEqual({ kind: 'nothing' });
  });

  test('gives way to a later one', async () => {
    const asked = net();
    const { receiver, delivered } = listened();
    receiver.receive(link(CAT, null));
    receiver.accept();
    receiver.receive(link(OWN, null));
    await settled();
    expect(asked).toEqual(['https://data.example/cat.obj', 'https://maps.example/own.obj']);
    expect(delivered.map(({ meshes }) => meshes[0]?.name)).toEqual(['own.obj']);
  });
});

test('files of the page’s own host come without a question', async () => {
  const asked = net();
  const { receiver, delivered } = listened();
  receiver.receive(link(OWN, null));
  await settled();
  expect(asked).toEqual(['https://maps.example/own.obj']);
  expect(delivered).toHaveLength(1);
});

describe('files by hand', () => {
  test('are taken by their content, whatever they are called, in any order', async () => {
    const { receiver, said, delivered } = listened();
    receiver.receive(link(await local('cat.off', 'a cat'), await local('lion.off', 'a lion')));
    expect(said.at(-1)).toEqual({
      kind: 'files',
      missing: [
        { side: 0, name: 'cat.off' },
        { side: 1, name: 'lion.off' },
      ],
    });
    const others = await receiver.take([
      { name: 'renamed.off', bytes: bytes('a lion') },
      { name: 'cat.off', bytes: bytes('another cat') },
    ]);
    expect(others.map(({ name }) => name)).toEqual(['cat.off']);
    expect(said.at(-1)).toEqual({ kind: 'files', missing: [{ side: 0, name: 'cat.off' }] });
    expect(delivered).toEqual([]);
    expect(await receiver.take([{ name: 'x', bytes: bytes('a cat') }])).toEqual([]);
    expect(delivered[0]?.meshes.map((mesh) => [mesh?.name, mesh?.address])).toEqual([
      ['cat.off', null],
      ['lion.off', null],
    ]);
    expect(delivered[0]?.meshes[1]?.bytes).toEqual(bytes('a lion'));
  });

  test('may be one file for both sides, and come after those that are fetched', async () => {
    net();
    const { receiver, said, delivered } = listened();
    const cat = await local('cat.off', 'a cat');
    receiver.receive(link(cat, cat));
    expect(await receiver.take([{ name: 'cat.off', bytes: bytes('a cat') }])).toEqual([]);
    expect(delivered).toHaveLength(1);
    receiver.receive(link(cat, CAT));
    receiver.accept();
    await settled();
    expect(said.at(-1)).toEqual({ kind: 'files', missing: [{ side: 0, name: 'cat.off' }] });
    await receiver.take([{ name: 'cat.off', bytes: bytes('a cat') }]);
    expect(delivered).toHaveLength(2);
  });

  test('are nobody’s where no link waits for them', async () => {
    const { receiver } = listened();
    const file = { name: 'cat.off', bytes: bytes('a cat') };
    expect(await receiver.take([file])).toEqual([file]);
  });

  test('are not told apart where the page may not hash them', async () => {
    const { receiver } = listened();
    receiver.receive(link(await local('cat.off', 'a cat'), null));
    vi.stubGlobal('crypto', {});
    const file = { name: 'cat.off', bytes: bytes('a cat') };
    expect(await receiver.take([file])).toEqual([file]);
  });
});
