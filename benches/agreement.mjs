// Makes the same maps natively and with the page's wasm module, and compares every number of the report and every byte of the map
// file. The seconds in both are not compared.
//
//     cargo xtask agree [PAIR.json ...]
//
// A pair file names its meshes in `source` and `target`, by paths that begin at its own folder or at the one above it; without files
// the pairs are all of ../shared/data. The module runs in Node, which needs no browser.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { initSync, runMap } from '../www/wasm/core.js';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const target = process.env['CARGO_TARGET_DIR'] ?? join(root, 'target');
const program = join(target, 'debug/conemap');
const data = join(root, '../shared/data/pairs');

/** The values inside a JSON value that hold no others (numbers, texts, truth values, nulls), by their paths. */
function* leaves(value, path = '') {
  if (value === null || typeof value !== 'object') {
    yield [path, value];
    return;
  }
  for (const [key, inner] of Object.entries(value)) {
    // Seconds differ in each run and are left out. Arrays of different lengths have different paths.
    if (key !== 'seconds') yield* leaves(inner, `${path}/${key}`);
  }
}

/** Relative difference of two numbers, 0 where they are the same, infinite where one is no number or missing. */
function difference(a, b) {
  if (a === b) return 0;
  if (typeof a !== 'number' || typeof b !== 'number') return Infinity;
  return Math.abs(a - b) / Math.max(Math.abs(a), Math.abs(b));
}

/** The sections of a map file by name, with the rest of its header; without the report, which holds seconds. */
function sections(map) {
  // The file begins with 16 bytes, the last four of which are the length of the header (docs/map-file.md).
  const begin = 16 + map.readUInt32LE(12);
  const { sections: entries, ...header } = JSON.parse(map.subarray(16, begin).toString('utf8'));
  const all = entries.map(({ name, offset, bytes }) => [name, map.subarray(begin + offset, begin + offset + bytes)]);
  return new Map([['header', Buffer.from(JSON.stringify(header))], ...all.filter(([name]) => name !== 'report')]);
}

/** The number of bytes that two map files have without their reports, and the sections that differ. */
function comparedMaps(ours, theirs) {
  const [a, b] = [sections(ours), sections(theirs)];
  const differing = [...new Set([...a.keys(), ...b.keys()])].filter((name) => !(a.get(name)?.equals(b.get(name) ?? Buffer.alloc(0)) ?? false));
  return { bytes: [...a.values()].reduce((sum, { length }) => sum + length, 0), differing };
}

/** The number of values that both reports have, and the path at which they differ most. */
function compared(ours, theirs) {
  const [a, b] = [new Map(leaves(ours)), new Map(leaves(theirs))];
  let worst = { relative: 0, path: '' };
  const paths = new Set([...a.keys(), ...b.keys()]);
  for (const path of paths) {
    const relative = difference(a.get(path), b.get(path));
    if (relative > worst.relative) worst = { relative, path };
  }
  return { count: paths.size, ...worst };
}

function meshes(pair) {
  const names = JSON.parse(readFileSync(pair, 'utf8'));
  return ['source', 'target'].map((side) => {
    const found = [dirname(pair), dirname(dirname(pair))].map((folder) => join(folder, names[side])).find(existsSync);
    if (found === undefined) throw new Error(`${pair}: there is no ${names[side]}`);
    return found;
  });
}

function native([source, target], pair, folder) {
  const [report, map] = ['report.json', 'map.conemap'].map((name) => join(folder, name));
  execFileSync(program, ['map', source, target, '--landmarks', pair, '--report', report, '--map', map], { stdio: 'pipe' });
  return { report: JSON.parse(readFileSync(report, 'utf8')), map: readFileSync(map) };
}

function wasm(files, pair) {
  const none = () => undefined;
  let findings = [];
  const found = (json) => {
    findings = typeof json === 'string' ? JSON.parse(json) : json;
  };
  const listener = { relaxes: none, progress: none, preview: none, found, wantsResult: () => false };
  const [source, target] = files.map((path) => readFileSync(path));
  const output = runMap(source, target, readFileSync(pair, 'utf8'), '{}', listener);
  const answer = { report: { ...JSON.parse(output.report()), findings }, map: Buffer.from(output.mapFile() ?? []) };
  output.free();
  return answer;
}

function line(pair, folder) {
  const files = meshes(pair);
  const [ours, theirs] = [native(files, pair, folder), wasm(files, pair)];
  const { count, relative, path } = compared(ours.report, theirs.report);
  const { bytes, differing } = comparedMaps(ours.map, theirs.map);
  const cells = [
    basename(pair, '.json').padEnd(20),
    ours.report.distortion.energy.toFixed(4).padStart(7),
    String(count).padStart(7),
    (relative === 0 ? '0' : relative.toExponential(1)).padStart(10),
    String(bytes).padStart(10),
    differing.length === 0 ? 'the same' : `DIFFER: ${differing.join(', ')}`,
    path,
  ];
  console.log(cells.join(' '));
  return relative === 0 && differing.length === 0;
}

const given = process.argv.slice(2);
if (given.length === 0 && !existsSync(data)) {
  console.log('skipped: ../shared/data is not there');
  process.exit(0);
}
const pairs =
  given.length > 0
    ? given
    : readdirSync(data)
        .filter((name) => name.endsWith('.json'))
        .sort()
        .map((name) => join(data, name));
const { memory } = initSync({ module: readFileSync(join(root, 'www/wasm/core_bg.wasm')) });
const folder = mkdtempSync(join(tmpdir(), 'conemap-agree-'));
try {
  console.log('pair                       E  values  rel. diff.  map file, bytes');
  const differ = pairs.filter((pair) => !line(pair, folder));
  console.log(`${differ.length} of ${pairs.length} pairs differ; the module's memory, which never shrinks, became ${Math.round(memory.buffer.byteLength / 2 ** 20)} MiB`);
  process.exitCode = differ.length > 0 ? 1 : 0;
} finally {
  rmSync(folder, { recursive: true });
}
