// Compares the time of whole maps as wasm in Chromium with the time of the native program: the same files, the same stages, runs
// of both in turn.
//
//     cargo xtask compare [--runs N] [PAIR.json ...]
//
// A pair file names its meshes in `source` and `target`, by paths that begin at its own folder or at the one above it;
// without files the pairs are the demos. Each wasm run is a browser of its own: `first` is its first map, in which quick
// code is replaced by optimised code while it runs; `later` is a second map, in a new worker with the same module, as the
// page makes it. Loading the module, starting the worker and writing files are not counted. Other work on the machine only
// ever adds time, so every figure is the least of all runs. `processor` is the processor time of the one thread that makes
// the map (native: of the program), which other work hardly disturbs; only Linux tells it.
import { chromium } from '@playwright/test';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const target = process.env['CARGO_TARGET_DIR'] ?? join(root, 'target');
const folder = join(target, 'compare');
const program = join(target, 'release/conemap');

/** The worker's program: it loads its files, says so, waits to be started, and posts its answer. */
const worker = `
import init, { buildDemo, demoList, runMap } from './wasm/core.js';
const bytes = async (path) => new Uint8Array(await (await fetch(path)).arrayBuffer());
const text = (array) => new TextDecoder().decode(array);
const demos = () => JSON.parse(demoList()).map(({ id }) => {
  const demo = buildDemo(id);
  return { name: id, files: [demo.source(), demo.target(), demo.landmarks()].map(text) };
});
const nothing = () => undefined;
const listener = { relaxes: nothing, progress: nothing, found: nothing, wantsResult: () => false };
const map = ([source, target, landmarks]) =>
  JSON.parse(runMap(source, target, text(landmarks), '{}', listener).report());
self.onmessage = async ({ data: { module, paths } }) => {
  await init({ module_or_path: module });
  const files = await Promise.all(paths.map(bytes));
  self.onmessage = () => {
    try {
      self.postMessage({ done: files.length > 0 ? map(files) : demos() });
    } catch (thrown) {
      self.postMessage({ failed: String(thrown) });
    }
  };
  self.postMessage('ready');
};`;

/** Serves the module, and the files by their numbers. */
async function serve(files) {
  const fixed = {
    '/': ['text/html', '<!doctype html><title>comparison</title>'],
    '/worker.js': ['text/javascript', worker],
    '/wasm/core.js': ['text/javascript', readFileSync(join(root, 'www/wasm/core.js'))],
    '/wasm/core_bg.wasm': ['application/wasm', readFileSync(join(root, 'www/wasm/core_bg.wasm'))],
  };
  const server = createServer((request, response) => {
    const [type, body] = fixed[request.url] ?? ['', files[Number(request.url.slice('/file/'.length))]];
    response.writeHead(body === undefined ? 404 : 200, { 'content-type': type }).end(body);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Runs so many workers one after the other in a new browser; returns their answers with the processor time of each. */
async function inBrowser(files, count) {
  const server = await serve(files);
  const browser = await chromium.launchServer({
    ...(process.env['CHROMIUM'] ? { executablePath: process.env['CHROMIUM'] } : {}),
    args: ['--no-sandbox', '--no-first-run', '--disable-background-networking'],
  });
  try {
    const client = await chromium.connect(browser.wsEndpoint());
    const page = await client.newPage();
    await page.goto(server.address);
    const answers = [];
    while (answers.length < count) {
      await page.evaluate(ready, files.map((_, k) => `/file/${k}`));
      const before = workerSeconds(browser.process().pid);
      const answer = await page.evaluate(answered);
      answers.push({ answer, processor: workerSeconds(browser.process().pid) - before });
      await page.evaluate(() => globalThis.worker.terminate());
    }
    return answers;
  } finally {
    await browser.close();
    server.close();
  }
}

/** In the page: starts a worker and waits until it has everything that it needs. */
async function ready(paths) {
  globalThis.module ??= await WebAssembly.compileStreaming(fetch('/wasm/core_bg.wasm'));
  globalThis.worker = new Worker('/worker.js', { type: 'module' });
  await new Promise((resolve, reject) => {
    globalThis.worker.onmessage = resolve;
    globalThis.worker.onerror = ({ message }) => reject(new Error(message));
    globalThis.worker.postMessage({ module: globalThis.module, paths });
  });
}

/** In the page: lets the worker begin and waits for its answer. */
function answered() {
  return new Promise((resolve, reject) => {
    globalThis.worker.onmessage = ({ data }) =>
      'done' in data ? resolve(data.done) : reject(new Error(data.failed));
    globalThis.worker.onerror = ({ message }) => reject(new Error(message));
    globalThis.worker.postMessage('begin');
  });
}

/** Seconds that the threads of all workers of a browser have run; NaN where the system does not tell. */
function workerSeconds(browser) {
  if (process.platform !== 'linux') return NaN;
  const processes = [browser];
  const threads = (id) => readdirSync(`/proc/${id}/task`).map((thread) => `/proc/${id}/task/${thread}`);
  const read = (path) => readFileSync(path, 'utf8').trim();
  let seconds = 0;
  for (const id of processes) {
    try {
      for (const thread of threads(id)) {
        processes.push(...read(`${thread}/children`).split(' ').filter((child) => child !== ''));
        if (read(`${thread}/comm`).startsWith('DedicatedWorker')) {
          seconds += Number(read(`${thread}/schedstat`).split(' ')[0]) / 1e9;
        }
      }
    } catch {
      // The process has ended in the meantime; those with workers are still there.
    }
  }
  return seconds;
}

/** Seconds of processor time of all programs that this one has run to their end; NaN where the system does not tell. */
function childSeconds() {
  if (process.platform !== 'linux') return NaN;
  // The times stand after the name in brackets, in hundredths of a second.
  const [user, system] = readFileSync('/proc/self/stat', 'utf8').split(') ')[1].split(' ').slice(13, 15);
  return (Number(user) + Number(system)) / 100;
}

function native([source, target, landmarks]) {
  const report = join(folder, 'report.json');
  const before = childSeconds();
  execFileSync(program, ['map', source, target, '--landmarks', landmarks, '--report', report], { stdio: 'pipe' });
  return { answer: JSON.parse(readFileSync(report, 'utf8')), processor: childSeconds() - before };
}

/** The demos, written as files for both sides. */
async function demos() {
  const [{ answer }] = await inBrowser([], 1);
  return answer.map(({ name, files }) => {
    const paths = ['source.obj', 'target.obj', 'landmarks.json'].map((file) => join(folder, `${name}-${file}`));
    files.forEach((text, k) => writeFileSync(paths[k], text));
    return { name, paths };
  });
}

function pair(path) {
  const { source, target } = JSON.parse(readFileSync(path, 'utf8'));
  const mesh = (named) => {
    const places = [dirname(path), join(dirname(path), '..')].map((place) => join(place, named));
    const found = places.find((place) => existsSync(place));
    if (found === undefined) throw new Error(`${path} names ${named}, which is not there`);
    return found;
  };
  return { name: basename(path, '.json'), paths: [mesh(source), mesh(target), path] };
}

/** The least seconds of each stage over runs, and the least processor time. */
function least(runs) {
  const rows = runs.map(({ answer, processor }) => ({ ...answer.seconds, processor }));
  const names = [...new Set(rows.flatMap((row) => Object.keys(row)))];
  return Object.fromEntries(names.map((name) => [name, Math.min(...rows.map((row) => row[name] ?? NaN))]));
}

/** The energy at which all runs of a map end, to 12 digits; throws where they differ. */
function judge(name, runs) {
  const energies = new Set(runs.map(({ answer }) => answer.distortion.energy.toPrecision(12)));
  if (energies.size > 1) throw new Error(`${name}: the runs' energies differ: ${[...energies].join(', ')}`);
  return [...energies][0];
}

async function compare({ name, paths }, count) {
  const files = paths.map((path) => readFileSync(path));
  const runs = { native: [], first: [], later: [] };
  for (let run = 0; run < count; run += 1) {
    runs.native.push(native(paths));
    const [first, later] = await inBrowser(files, 2);
    runs.first.push(first);
    runs.later.push(later);
  }
  console.log(`\n${name}, energy ${judge(name, Object.values(runs).flat())}`);
  print(least(runs.native), [least(runs.first), least(runs.later)]);
}

function print(native, wasm) {
  console.log('seconds               native   first  ratio   later  ratio');
  const stages = Object.keys(native).filter((stage) => stage !== 'total' && stage !== 'processor');
  for (const row of [...stages, 'total', 'processor'].filter((row) => native[row] >= 0.01)) {
    const cells = wasm.map((seconds) => [seconds[row].toFixed(3), (seconds[row] / native[row]).toFixed(2)]);
    const line = [native[row].toFixed(3), ...cells.flat()].map((cell, k) => cell.padStart(k > 0 && k % 2 === 0 ? 7 : 8));
    console.log(`${row.padEnd(20)}${line.join('')}`);
  }
}

const given = process.argv.slice(2);
const option = given.indexOf('--runs');
const [, count] = option < 0 ? ['', 5] : given.splice(option, 2).map(Number);
mkdirSync(folder, { recursive: true });
for (const one of given.length > 0 ? given.map(pair) : await demos()) {
  await compare(one, count);
}
