/** The gallery of demos has a picture and a sentence for each demo of the core. */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, test } from 'vitest';
import { sightOf } from '../../www/panels/gallery.tsx';
import { guideSection } from '../../www/send/guide-link.ts';
import type { Demo } from '../../www/store/state.ts';
import { demoList } from '../../www/wasm/page.js';
import { startPageModule } from './modules.ts';

const FOLDER = fileURLToPath(new URL('../../www/public/demos/', import.meta.url));
/** The most bytes of a picture's file. */
const LARGEST = 12_000;

beforeAll(() => {
  startPageModule();
});

describe('the gallery', () => {
  test('has a small picture of every demo (npm run thumbnails), and of nothing else', () => {
    const demos = JSON.parse(demoList()) as Demo[];
    expect(readdirSync(FOLDER).sort()).toEqual(demos.map(({ id }) => `${id}.webp`).sort());
    for (const { id } of demos) {
      const bytes = readFileSync(`${FOLDER}${id}.webp`);
      expect(bytes.length).toBeLessThanOrEqual(LARGEST);
      expect([bytes.toString('latin1', 0, 4), bytes.toString('latin1', 8, 12)]).toEqual(['RIFF', 'WEBP']);
    }
  });

  test('says of every demo what to see in it', () => {
    for (const demo of JSON.parse(demoList()) as Demo[]) {
      expect(sightOf(demo)).toMatch(/^See .*\.$/);
    }
    expect(sightOf({ id: 'other', title: 'Other', sentence: 'Something else' })).toBe('Something else.');
  });
});

describe('a link to the guide', () => {
  test('names a section or its beginning', () => {
    expect(guideSection('#guide')).toBe('');
    expect(guideSection('#guide=')).toBe('');
    expect(guideSection('#guide=numbers')).toBe('numbers');
  });

  test('is no other link', () => {
    for (const hash of ['', '#', '#demo=poses', '#guided', '#guide=<b>', '#guide=a&demo=b', `#guide=${'a'.repeat(21)}`]) {
      expect(guideSection(hash)).toBeNull();
    }
  });
});
