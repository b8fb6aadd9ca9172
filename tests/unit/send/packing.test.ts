/** Text packed into an address, and the result of unpacking good and damaged texts. */
import { deflateSync } from 'fflate';
import { describe, expect, test } from 'vitest';
import { fromBase64Url, toBase64Url } from '../../../www/send/base64url.ts';
import { pack, unpack } from '../../../www/send/packing.ts';
import { Random } from '../random.ts';

describe('base64url', () => {
  test('gives the bytes back, of every length', () => {
    const random = new Random(1);
    for (let length = 0; length < 70; length++) {
      const bytes = random.bytes(length);
      const text = toBase64Url(bytes);
      expect(text).toMatch(/^[\w-]*$/);
      expect(text).toBe(Buffer.from(bytes).toString('base64url'));
      expect(fromBase64Url(text)).toEqual(bytes);
    }
    const long = random.bytes(20_000);
    expect(fromBase64Url(toBase64Url(long))).toEqual(long);
  });

  test('takes nothing else', () => {
    for (const text of ['A', 'AAAAA', 'AA==', 'A+AA', 'A/AA', 'A AA', 'AÄAA', 'AAA\n']) {
      expect(fromBase64Url(text), text).toBeNull();
    }
  });
});

describe('packing', () => {
  test('gives the text back, short and long, in every script', () => {
    const random = new Random(2);
    for (const text of ['', 'a', 'ear, left – 左の耳 🐈', JSON.stringify([...random.bytes(30_000)]), 'a'.repeat(900_000)]) {
      expect(unpack(pack(text), 1_000_000)).toBe(text);
    }
  });

  test('refuses more than the limit, without taking the memory for it', () => {
    const text = 'a'.repeat(1000);
    expect(unpack(pack(text), 1000)).toBe(text);
    expect(unpack(pack(text), 999)).toBeNull();
    // 48 kB that would unpack to 48 MB.
    const bomb = toBase64Url(deflateSync(new Uint8Array(48_000_000)));
    expect(bomb.length).toBeLessThan(65_536);
    const before = process.memoryUsage().arrayBuffers;
    expect(unpack(bomb, 1_000_000)).toBeNull();
    expect(process.memoryUsage().arrayBuffers - before).toBeLessThan(16_000_000);
  });

  test('refuses what is cut off, what is damaged and what is no text', () => {
    const packed = pack(JSON.stringify(Array.from({ length: 300 }, (_, index) => index * index)));
    for (let end = 0; end < packed.length; end += 7) {
      expect(unpack(packed.slice(0, end), 1_000_000), String(end)).toBeNull();
    }
    expect(unpack('!', 100)).toBeNull();
    expect(unpack(toBase64Url(deflateSync(new Uint8Array([0xff, 0xfe, 0xc0]))), 100)).toBeNull();
  });
});
