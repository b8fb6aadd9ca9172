/** Links: the whole content comes back, old links are read, and hostile ones are refused. */
import { deflateSync } from 'fflate';
import { describe, expect, test } from 'vitest';
import { toBase64Url } from '../../../www/send/base64url.ts';
import type { Link, Reading } from '../../../www/send/link.ts';
import { LARGEST_JSON, LONGEST_LINK, readLink, writeLink } from '../../../www/send/link.ts';
import { pack, unpack } from '../../../www/send/packing.ts';
import { linkAddress, prospectOf, SAFE_LENGTH } from '../../../www/send/share.ts';
import { prospectSentence } from '../../../www/messages.ts';
import { INITIAL } from '../../../www/store/state.ts';
import { Random } from '../random.ts';
import { addressFile, anyLink, anyWork, BASE, clickedWork, localFile } from './works.ts';

function linkAt(hash: string): Link {
  const reading = readLink(hash, BASE);
  if (reading.kind !== 'link') {
    throw new Error(`no link: ${JSON.stringify(reading)}`);
  }
  return reading.link;
}

/** The result of reading a link of version 1 with this JSON. */
function readJson(value: unknown): Reading {
  return readLink(`#s=1.${pack(JSON.stringify(value))}`, BASE);
}

/** The JSON in a link. */
function jsonIn(hash: string): Record<string, unknown> {
  return JSON.parse(unpack(hash.slice('#s=1.'.length), LARGEST_JSON) ?? 'null') as Record<string, unknown>;
}

const DAMAGED: Reading = { kind: 'refused', fault: 'damaged' };

describe('a link', () => {
  test('gives back all that was put in, a thousand times', { timeout: 60_000 }, () => {
    const random = new Random(11);
    for (let round = 0; round < 1000; round++) {
      const link = anyLink(random);
      const hash = writeLink(link);
      expect(hash).toMatch(link.files.some((file) => file?.kind === 'demo') ? /^#s=2\.[\w-]+$/ : /^#s=1\.[\w-]+$/);
      expect(linkAt(hash)).toEqual(link);
      expect(writeLink(linkAt(hash))).toBe(hash);
    }
  });

  test('with 50 pairs clicked on meshes of 500,000 faces has fewer than 2,000 characters, from the first to the last', () => {
    const lengths: number[] = [];
    for (let seed = 1; seed <= 30; seed++) {
      const work = clickedWork(new Random(seed), 50);
      const link: Link = { demo: null, files: [localFile('a-cat-with-a-long-name.off'), localFile('lion.off', 'x')], landmarks: null, work };
      // The hash of a file may be any bytes.
      const random = new Random(seed + 100);
      const hashes = link.files.map((file) => ({ ...file, hash: toBase64Url(random.bytes(32)) }) as Link['files'][0]);
      const sent: Link = { ...link, files: [hashes[0] ?? null, hashes[1] ?? null] };
      const address = linkAddress(sent, new URL('https://someone.example.org/conemap/index.html'));
      expect(linkAt(new URL(address).hash)).toEqual(sent);
      lengths.push(address.length);
    }
    const longest = Math.max(...lengths);
    // The lengths were 1591 to 1618 when this was written, and 30 more with a texture that was turned; this leaves room for labels.
    expect(SAFE_LENGTH).toBe(2000);
    expect(longest).toBeLessThan(1680);
  });

  test('keeps points to the last bit, also those that no click made', () => {
    const work = anyWork(new Random(5));
    const points = [
      { face: 7, barycentric: [0.1, 0.2, 0.7] },
      { face: 7, barycentric: [0.1, 0.2, 0.7000000000000001] },
      { face: 7, barycentric: [1 / 3, 1 / 3, 1 / 3] },
      { face: 0, barycentric: [1, 0, 0] },
      4_294_967_295,
    ] as const;
    const pairs = points.map((point, index) => ({ number: index + 1, points: [point, 0] as const, label: '', locked: false }));
    const link: Link = { demo: 'ball', files: [null, null], landmarks: null, work: { ...work, pairs } };
    expect(linkAt(writeLink(link)).work?.pairs.map((pair) => pair.points[0])).toEqual(points);
  });

  test('rounds a camera to five figures and nothing else', () => {
    const work = { ...anyWork(new Random(6)), cameras: [[0.123456789, 1e-9, 123456.789], null] as const };
    const link: Link = { demo: 'ball', files: [null, null], landmarks: null, work };
    expect(linkAt(writeLink(link)).work).toEqual({ ...work, cameras: [[0.12346, 1e-9, 123460], null] });
  });
});

describe('a link of version 1 from another day', () => {
  // This link was written down on the day on which version 1 was made, and must stay readable for ever.
  const FIRST =
    '{"f":[["https://data.example/cat.obj"],["AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA","lion.off"]],"p":[[[7],1220245012],[[],[3,0.25,0.25,0.5]]],"i":[1,4],"n":["nose",""],"x":[1],"g":"same","u":["y","-z"],"o":{"method":"relaxed","base":"joint","cones":"base-domain","class":"best","ownCones":null},"c":[[1,2],null],"s":{"surface":"shaded","patchLines":true,"cones":true,"markers":true}}';

  test('says the same', () => {
    const link = linkAt(`#s=1.${pack(FIRST)}`);
    expect(link).toEqual({
      demo: null,
      files: [addressFile('https://data.example/cat.obj'), localFile('lion.off')],
      landmarks: null,
      work: {
        pairs: [
          { number: 1, points: [7, null], label: 'nose', locked: false },
          {
            number: 4,
            points: [
              { face: 12, barycentric: [0.2, 0.3, 0.5] },
              { face: 3, barycentric: [0.25, 0.25, 0.5] },
            ],
            label: '',
            locked: true,
          },
        ],
        up: ['y', '-z'],
        groundTruth: 'same',
        options: { method: 'relaxed', base: 'joint', cones: 'base-domain', class: 'best', ownCones: null, borders: 'guess' },
        cameras: [[1, 2], null],
        style: { surface: 'shaded', texture: { cells: 36, turn: 0, x: 0, y: 0 }, patchLines: true, textureBoundary: false, cones: true, markers: true, morph: 0, wipe: null },
      },
    });
  });

  test('may have more in it than this page knows', () => {
    expect(readJson({ ...(JSON.parse(FIRST) as object), later: { anything: [1] } }).kind).toBe('link');
  });
});

describe('an old link', () => {
  test('to a demo is read as ever', () => {
    for (const [hash, demo] of [
      ['#demo=cat-dog', 'cat-dog'],
      ['#demo=cat%20dog', 'cat dog'],
      ['demo=cat', 'cat'],
      ['#a=b&demo=cat', 'cat'],
    ] as const) {
      expect(linkAt(hash)).toEqual({ demo, files: [null, null], landmarks: null, work: null });
    }
    const link: Link = { demo: 'cat & dog', files: [null, null], landmarks: null, work: null };
    expect(linkAt(writeLink(link))).toEqual(link);
  });

  test('is none where nothing is said', () => {
    for (const hash of ['', '#', '#demo=', '#top', '#a=b', '#source', '##']) {
      const reading = readLink(hash, BASE);
      expect(reading.kind, hash).toBe(hash === '#source' ? 'refused' : 'none');
    }
  });
});

describe('a link of addresses', () => {
  test('names meshes and landmarks', () => {
    const hash = `#source=${encodeURIComponent('https://data.example/cat.obj?a=1&b=2')}&target=lion.obj&landmarks=https://data.example/pairs.json`;
    const link = linkAt(hash);
    expect(link).toEqual({
      demo: null,
      files: [
        addressFile('https://data.example/cat.obj?a=1&b=2'),
        { kind: 'address', address: { url: 'https://maps.example/conemap/lion.obj', name: 'lion.obj', host: null } },
      ],
      landmarks: { url: 'https://data.example/pairs.json', name: 'pairs.json', host: 'data.example' },
      work: null,
    });
    expect(linkAt(writeLink(link))).toEqual(link);
  });

  test('is refused with its reason', () => {
    const faults = {
      '#source=http://data.example/cat.obj': 'not-https',
      '#target=javascript:alert(1)': 'not-https',
      '#source=https://a:b@c.example/cat.obj': 'has-password',
      '#source=https://': 'no-address',
      '#landmarks=https://data.example/pairs.json': 'no-mesh',
      [`#source=https://a.b/${'c'.repeat(3000)}`]: 'too-long',
    };
    for (const [hash, fault] of Object.entries(faults)) {
      expect(readLink(hash, BASE), hash).toEqual({ kind: 'refused', fault });
    }
  });
});

describe('a hostile link', () => {
  const good = writeLink({ demo: 'ball', files: [null, null], landmarks: null, work: clickedWork(new Random(7), 20) });

  test('is refused by its length before anything is read of it', () => {
    expect(readLink(`#s=1.${'A'.repeat(LONGEST_LINK)}`, BASE)).toEqual({ kind: 'refused', fault: 'too-long' });
    const bomb = toBase64Url(deflateSync(new Uint8Array(40_000_000)));
    expect(readLink(`#s=1.${bomb}`, BASE)).toEqual(DAMAGED);
  });

  test('of a later version says so', () => {
    for (const version of ['3', '17', '999999999']) {
      expect(readLink(good.replace('#s=1.', `#s=${version}.`), BASE)).toEqual({ kind: 'refused', fault: 'newer' });
    }
    for (const version of ['', '0', '-1', '1e3', 'x', '9999999999']) {
      expect(readLink(good.replace('#s=1.', `#s=${version}.`), BASE), version).toEqual(DAMAGED);
    }
  });

  test('of another shape is refused, part by part', () => {
    const json = jsonIn(good);
    expect(readJson(json).kind).toBe('link');
    const wrong: Record<string, unknown[]> = {
      d: ['', 1, 'a'.repeat(10_001), null],
      f: [[], [['https://a.b/c']], [['x', 'y'], []], 'x'],
      p: [
        ...[[], [[1]], [[1], []], [[1], [[]], []], [[[]], [[]]], null],
        ...[-1, 1.5, 2 ** 53, 10_000 * 10_001 + 1, '1', true, {}, [-1], [2 ** 32], [1, 2], [1, 2, 3], [1, 0.5, 9, 0], [1, 0.5, 0.5, null]].map(
          (point) => [[point], [1]],
        ),
      ],
      i: [[], [1], json['p'], Array.from({ length: 20 }, () => 1), Array.from({ length: 20 }, (_, index) => index)],
      n: ['x', [1], ['a'.repeat(10_001)]],
      x: [[-1], 'x', [0.5]],
      u: [['y'], ['y', 'up'], null],
      o: [{}, { ...(json['o'] as object), method: 'other' }, { ...(json['o'] as object), ownCones: 1e9 }, null],
      g: ['a'.repeat(10_001), 5],
    };
    for (const [key, values] of Object.entries(wrong)) {
      for (const value of values) {
        expect(readJson({ ...json, [key]: value }).kind, `${key}: ${JSON.stringify(value)}`).toBe('refused');
      }
    }
    for (const value of [null, 1, 'x', [], {}, [json]]) {
      expect(readJson(value)).toEqual(DAMAGED);
    }
    expect(readLink(`#s=1.${pack('{"d":"ball"')}`, BASE)).toEqual(DAMAGED);
  });

  test('that looks at its work in a way that this page does not know shows the work all the same', () => {
    const json = jsonIn(good);
    const camera = Array.from({ length: 33 }, () => 1);
    const start = { cameras: [null, null], style: INITIAL.ui.style };
    const { work } = linkAt(good);
    for (const c of [[null], [camera, null], [['1'], null], 'x']) {
      expect(readJson({ ...json, c })).toMatchObject({ link: { work: { ...work, cameras: start.cameras } } });
    }
    for (const s of [{}, { ...(json['s'] as object), surface: 'url(x)' }, { ...(json['s'] as object), morph: 1.1 }, 1]) {
      expect(readJson({ ...json, s })).toMatchObject({ link: { work: { ...work, style: start.style } } });
    }
  });

  test('cannot reach what it should not by odd names', () => {
    const json = JSON.stringify(jsonIn(good));
    const odd = `${json.slice(0, -1)},"__proto__":{"polluted":1},"constructor":1}`;
    const link = readLink(`#s=1.${pack(odd)}`, BASE);
    expect(link.kind).toBe('link');
    expect(({} as Record<string, unknown>)['polluted']).toBeUndefined();
  });

  test('as large as can be is answered soon', { timeout: 60_000 }, () => {
    const heavy = [
      `{"d":"x","p":[[${'[],'.repeat(130_000)}1],[1]]}`,
      `{"d":"x","x":[${'1,'.repeat(150_000)}1],"p":[[${'1,'.repeat(40_000)}1],[1]]}`,
      '['.repeat(390_000),
      `{"d":"x","p":[[${'{"a":1},'.repeat(50_000)}1],[1]]}`,
    ];
    for (const json of heavy) {
      const begun = performance.now();
      expect(readLink(`#s=1.${pack(json)}`, BASE)).toEqual(DAMAGED);
      expect(performance.now() - begun).toBeLessThan(2500);
    }
  });

  test('is a document or is refused, ten thousand times', { timeout: 60_000 }, () => {
    const random = new Random(12);
    const kinds = new Map<string, number>();
    const count = (reading: Reading): void => {
      const kind = reading.kind === 'refused' ? reading.fault : reading.kind;
      kinds.set(kind, (kinds.get(kind) ?? 0) + 1);
      if (reading.kind === 'link') {
        // A link that was accepted is complete: it can be written and read again.
        const again = writeLink(reading.link);
        expect(writeLink(linkAt(again))).toBe(again);
      }
    };
    const text = JSON.stringify(jsonIn(good));
    const letters = Array.from('#s=1.&%{}[]",:-+eE0123456789abnulltrue\\/\u0000é𝄞');
    const mutated = (from: string): string => {
      const characters = Array.from(from);
      for (let change = random.below(4); change >= 0; change--) {
        const at = random.below(characters.length + 1);
        characters.splice(at, random.below(3), ...(random.unit() < 0.7 ? [random.of(letters)] : []));
      }
      return random.unit() < 0.1 ? characters.slice(0, random.below(characters.length + 1)).join('') : characters.join('');
    };
    for (let round = 0; round < 10_000; round++) {
      // Half of the links are damaged after packing, the other half before.
      count(round % 2 === 0 ? readLink(mutated(good), BASE) : readLink(`#s=1.${pack(mutated(text))}`, BASE));
    }
    // Damage is found; some damaged documents are still valid, with another number in them.
    expect(kinds.get('damaged')).toBeGreaterThan(3000);
    expect(kinds.get('link')).toBeGreaterThan(300);
  });
});

test('the receiver’s prospect is told', () => {
  const work = clickedWork(new Random(8), 4);
  const sentence = (link: Link): string => prospectSentence(prospectOf(link, linkAddress(link, BASE)));
  const link: Link = { demo: null, files: [null, null], landmarks: null, work };
  expect(sentence({ ...link, demo: 'ball' })).toMatch(/sees everything: meshes, landmarks/);
  expect(sentence({ ...link, files: [addressFile('https://a.example/x.obj'), addressFile('https://b.example/y.obj')] })).toMatch(
    /after one click that loads the meshes from a\.example and b\.example/,
  );
  expect(sentence({ ...link, files: [localFile('cat.off'), addressFile('https://b.example/y.obj')] })).toMatch(
    /needs cat\.off as well: send the file along/,
  );
  expect(sentence({ ...link, files: [localFile('cat.off'), localFile('lion.off')] })).toMatch(/needs cat\.off and lion\.off as well: send the files/);
  expect(sentence({ ...link, demo: 'ball', work: clickedWork(new Random(9), 500) })).toMatch(/longer than 2,000 characters/);
});

test('a link leaves out what the sender had behind the question mark', () => {
  const link: Link = { demo: 'ball', files: [null, null], landmarks: null, work: null };
  expect(linkAddress(link, new URL('https://a.b/c/?private=1#s=1.x'))).toBe('https://a.b/c/#demo=ball');
});
