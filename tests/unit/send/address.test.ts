/** Addresses in links: which are accepted, and what is shown of them. */
import { describe, expect, test } from 'vitest';
import { addressOf, LONGEST_ADDRESS, shownName } from '../../../www/send/address.ts';

const BASE = new URL('https://maps.example/tools/conemap/?a=b#s=1.x');

describe('an address', () => {
  test('by https is taken, with its host and its file', () => {
    expect(addressOf('https://data.example:8443/a/b/cat%20one.obj?version=2#part', BASE)).toEqual({
      url: 'https://data.example:8443/a/b/cat%20one.obj?version=2',
      name: 'cat one.obj',
      host: 'data.example:8443',
    });
  });

  test('without a host is the page’s own, from its folder', () => {
    expect(addressOf('meshes/cat.obj', BASE)).toEqual({
      url: 'https://maps.example/tools/conemap/meshes/cat.obj',
      name: 'cat.obj',
      host: null,
    });
    expect(addressOf('https://maps.example/cat.obj', BASE)).toMatchObject({ host: null });
    const local = new URL('http://127.0.0.1:4173/');
    expect(addressOf('cat.obj', local)).toMatchObject({ url: 'http://127.0.0.1:4173/cat.obj', host: null });
    expect(addressOf('http://127.0.0.1:4174/cat.obj', local)).toBe('not-https');
  });

  test('shows the host as the browser resolves it, whatever letters it was written with', () => {
    // The first letter is Cyrillic.
    expect(addressOf('https://еxample.org/cat.obj', BASE)).toMatchObject({ host: 'xn--xample-2of.org' });
    expect(addressOf('https://maps.example.evil.org/cat.obj', BASE)).toMatchObject({ host: 'maps.example.evil.org' });
    expect(addressOf('//data.example/cat.obj', BASE)).toMatchObject({ host: 'data.example' });
    expect(addressOf('\\\\data.example\\cat.obj', BASE)).toMatchObject({ host: 'data.example' });
  });

  test('by any other way is refused', () => {
    for (const text of ['http://data.example/cat.obj', 'file:///etc/passwd', 'javascript:alert(1)', 'data:,x', 'ftp://a.b/c', 'blob:https://a.b/c']) {
      expect(addressOf(text, BASE), text).toBe('not-https');
    }
    for (const text of ['', '   ', 'https://', 'https://a b/', 'https://[::1/cat.obj']) {
      expect(addressOf(text, BASE), text).toBe('no-address');
    }
    expect(addressOf('https://maps.example@evil.org/cat.obj', BASE)).toBe('has-password');
    expect(addressOf('https://:secret@maps.example/cat.obj', BASE)).toBe('has-password');
    expect(addressOf(`https://a.b/${'c'.repeat(LONGEST_ADDRESS)}`, BASE)).toBe('too-long');
  });
});

describe('a name to show', () => {
  test('is one line without folders and without what turns the text around', () => {
    expect(shownName('a/b\\cat.obj')).toBe('cat.obj');
    expect(shownName('cat\u202ejbo.exe\n\u0000')).toBe('catjbo.exe');
    expect(shownName('猫.obj')).toBe('猫.obj');
    expect(Array.from(shownName('🐈'.repeat(500)))).toHaveLength(80);
  });

  test('is there for every address', () => {
    expect(addressOf('https://a.b/', BASE)).toMatchObject({ name: 'file' });
    expect(addressOf('https://a.b/%E0%A4%A', BASE)).toMatchObject({ name: '%E0%A4%A' });
    expect(addressOf('https://a.b/x%2Fy', BASE)).toMatchObject({ name: 'y' });
  });
});
