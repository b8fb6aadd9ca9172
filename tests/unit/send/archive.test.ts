/** Archives: what is written can be read again, and hostile archives are refused. */
import { zipSync } from 'fflate';
import { describe, expect, test } from 'vitest';
import { ArchiveRefused, isArchive, LARGEST_CONTENT, MOST_ENTRIES, readArchive, writeArchive } from '../../../www/send/archive.ts';
import { Random } from '../random.ts';

function faultOf(work: () => unknown): unknown {
  try {
    return work();
  } catch (thrown) {
    return thrown instanceof ArchiveRefused ? thrown.fault : thrown;
  }
}

/** An archive whose directory gives this size for every file. */
function withSizes(archive: Uint8Array, size: number): Uint8Array<ArrayBuffer> {
  const bytes = Uint8Array.from(archive);
  const view = new DataView(bytes.buffer);
  for (let at = 0; at + 46 <= bytes.length; at++) {
    if (view.getUint32(at, true) === 0x02014b50) {
      view.setUint32(at + 24, size, true);
    }
  }
  return bytes;
}

describe('an archive', () => {
  test('gives its files back, byte for byte, and is the same every time', () => {
    const random = new Random(3);
    const entries = {
      'source/cat.off': random.bytes(100_000),
      'target/猫 🐈.off': new TextEncoder().encode('OFF\n'.repeat(10_000)),
      'empty.json': new Uint8Array(0),
    };
    const archive = writeArchive(entries);
    expect(isArchive(archive)).toBe(true);
    expect({ ...readArchive(archive, Object.keys(entries)) }).toEqual(entries);
    expect(Object.keys(readArchive(archive, ['empty.json', 'not-there.json']))).toEqual(['empty.json']);
    expect(writeArchive(entries)).toEqual(archive);
  });

  test('is told from other files', () => {
    expect(isArchive(new TextEncoder().encode('OFF\n3 1 0'))).toBe(false);
    expect(isArchive(new Uint8Array(0))).toBe(false);
    expect(isArchive(writeArchive({}))).toBe(true);
  });

  test('of too many files is refused', () => {
    const names = Array.from({ length: MOST_ENTRIES + 1 }, (_, index) => `n${index}`);
    const files = (count: number): Record<string, Uint8Array<ArrayBuffer>> =>
      Object.fromEntries(names.slice(0, count).map((name) => [name, new Uint8Array(1)]));
    expect(Object.keys(readArchive(writeArchive(files(MOST_ENTRIES)), names))).toHaveLength(MOST_ENTRIES);
    expect(faultOf(() => readArchive(writeArchive(files(MOST_ENTRIES + 1)), names))).toBe('too-many');
  });

  test('that would become too large is refused before any memory is taken', () => {
    const archive = withSizes(zipSync({ a: new Uint8Array(1000), b: new Uint8Array(1000) }), LARGEST_CONTENT / 2 + 1);
    const before = process.memoryUsage().arrayBuffers;
    expect(faultOf(() => readArchive(archive, ['a', 'b']))).toBe('too-large');
    expect(process.memoryUsage().arrayBuffers - before).toBeLessThan(LARGEST_CONTENT);
  });

  test('that says less than it holds gives no more than it says', () => {
    const archive = withSizes(zipSync({ a: new Uint8Array(10_000_000) }), 10);
    const read = faultOf(() => readArchive(archive, ['a']));
    expect(read === 'no-archive' || (read as Record<string, Uint8Array>)['a']?.length === 10).toBe(true);
  });

  test('that is damaged is refused or gives some bytes, and never anything else', () => {
    const random = new Random(4);
    const archive = writeArchive({ 'conemap.json': random.bytes(500), 'source/a.off': new Uint8Array(3000) });
    for (let round = 0; round < 3000; round++) {
      const damaged = archive.slice(0, random.unit() < 0.3 ? random.below(archive.length) : archive.length);
      for (let change = random.below(4); change >= 0 && damaged.length > 0; change--) {
        damaged[random.below(damaged.length)] = random.below(256);
      }
      const read = faultOf(() => readArchive(damaged, ['conemap.json', 'source/a.off']));
      if (read instanceof Error) {
        throw read;
      }
    }
  });
});
