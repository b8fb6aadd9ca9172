/**
 * The same input gives the same result natively and in the page; this is the page's half of the test. The native tests write the files of
 * their maps (`tests/made_meshes/agreement.rs`); here the page's wasm module makes the same maps.
 */
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, test } from 'vitest';
import { buildDemo, openMap, runMap } from '../../www/wasm/core.js';
import { startCoreModule } from './modules.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const LEFT = join(process.env['CARGO_TARGET_DIR'] ?? join(ROOT, 'target'), 'tmp/agreement');

const SILENT = { relaxes: () => undefined, progress: () => undefined, preview: () => undefined, found: () => undefined, wantsResult: () => false };

function native(id: string, name: string): Buffer {
  const path = join(LEFT, id, name);
  if (!existsSync(path)) {
    throw new Error(`${path} is missing: run \`cargo test --test made_meshes agreement\` first`);
  }
  return readFileSync(path);
}

/** A report without its times, and without the findings, which the page asks for before the run. */
function report(json: string): unknown {
  return JSON.parse(json, (key, value: unknown) => {
    if (key === 'seconds' || key === 'findings') {
      return undefined;
    }
    // Platforms differ in the sign of zero.
    return typeof value === 'number' ? value + 0 : value;
  });
}

/** A text split into its numbers, zeros without their sign, and the parts between them. */
function numbers(text: string): readonly (number | string)[] {
  return text.split(/([-+]?\d[\d.]*(?:e[-+]?\d+)?)/i).map((part, index) => (index % 2 === 0 ? part : Number(part) + 0));
}

/** The first place where two texts differ, with both; `null` where they agree. */
function firstDifference(ours: readonly (number | string)[], theirs: readonly (number | string)[]): string | null {
  const place = Array.from({ length: Math.max(ours.length, theirs.length) }, (_, index) => index).find(
    (index) => ours[index] !== theirs[index],
  );
  return place === undefined ? null : `part ${place}: ${ours[place]} in the page, ${theirs[place]} natively`;
}

beforeAll(() => {
  startCoreModule();
});

describe.each(['sphere-tetrahedron', 'horse-cat'])('the map of the demo %s', (id) => {
  test('equals the native one in every number', () => {
    const demo = buildDemo(id);
    expect(Buffer.from(demo?.source() ?? [])).toEqual(native(id, 'source.obj'));
    expect(Buffer.from(demo?.target() ?? [])).toEqual(native(id, 'target.obj'));
    const landmarks = native(id, 'landmarks.json').toString();
    const meshes = [native(id, 'source.obj'), native(id, 'target.obj')] as const;
    const map = runMap(...meshes, landmarks, '{}', SILENT);

    const expected = report(native(id, 'report.json').toString());
    expect(expected).toHaveProperty('distortion.energy');
    expect(report(map.report())).toEqual(expected);
    const saved = openMap(map.mapFile() ?? new Uint8Array(), ...meshes);
    for (const name of ['vertex-images.json', 'target-vertex-images.json', 'vertex-distortion.csv', 'distortion.csv', 'layout-source.obj']) {
      const [ours, theirs] = [Buffer.from(saved.file(name)).toString(), native(id, name).toString()];
      expect(numbers(ours).length, name).toBeGreaterThan(1000);
      expect(firstDifference(numbers(ours), numbers(theirs)), name).toBeNull();
    }
    saved.free();
    map.free();
  });
});
