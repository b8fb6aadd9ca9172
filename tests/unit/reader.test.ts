/** The page's reader, with workers that only listen. */
import { beforeEach, expect, test, vi } from 'vitest';
import type { Question, ReaderAnswer, ReaderRequest } from '../../www/reading/messages.ts';
import { AskedWorker, ReaderBroken } from '../../www/reading/asked-worker.ts';
import { Reader, readMesh } from '../../www/reading/reader.ts';
import { fakeWorkers } from './fake-worker.ts';

const FakeWorker = fakeWorkers<ReaderAnswer>();
type FakeWorker = InstanceType<typeof FakeWorker>;

const [PAGE, CORE] = [{ name: 'page' }, { name: 'core' }] as unknown as readonly [WebAssembly.Module, WebAssembly.Module];
const FEW = 2 ** 20;
const SUGGEST: Extract<Question, { kind: 'suggest' }> = { kind: 'suggest', mesh: new Uint8Array(), marked: '[]' };
const TRAP = { code: 'trap', message: 'unreachable' };
const file = (name: string): { name: string; bytes: Uint8Array } => ({ name, bytes: new Uint8Array([1]) });
let reader: AskedWorker<Question>;

beforeEach(() => {
  FakeWorker.made = [];
  vi.stubGlobal('Worker', FakeWorker);
  reader = new AskedWorker(() => new Worker('reader.js'));
  reader.use(() => Promise.resolve(CORE));
});

/** The page's reader, with both modules loaded. */
function pageReader(): Reader {
  const both = new Reader();
  both.use(PAGE, () => Promise.resolve(CORE));
  return both;
}

/** The modules that a worker was given. */
const modules = (worker: FakeWorker | undefined): unknown[] =>
  ((worker?.posted ?? []) as ReaderRequest[]).flatMap((request) => (request.kind === 'module' ? [request.module] : []));

function last(): FakeWorker {
  const worker = FakeWorker.made.at(-1);
  if (worker === undefined) {
    throw new Error('no worker was made');
  }
  return worker;
}

/** The questions that a worker was asked, with their numbers. */
function asked(worker: FakeWorker): Extract<ReaderRequest, { kind: 'question' }>[] {
  return (worker.posted as ReaderRequest[]).filter((request) => request.kind === 'question');
}

const kinds = (worker: FakeWorker): string[] => asked(worker).map(({ question }) => question.kind);
const idOf = (worker: FakeWorker, place: number): number => asked(worker)[place]?.id ?? -1;

test('answers come to whoever asked, in whatever order', async () => {
  const first = reader.ask(SUGGEST, null);
  const second = reader.ask({ kind: 'demo', id: 'hands' }, null);
  expect(FakeWorker.made).toHaveLength(1);
  await Promise.resolve();
  expect(modules(last())).toEqual([CORE]);
  last().says({ kind: 'answer', id: idOf(last(), 1), memory: FEW, answer: null });
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: '[7]' });
  expect([await first, await second]).toEqual(['[7]', null]);
  expect(last().ended).toBe(false);
});

test('a refusal is a sentence, and the worker goes on', async () => {
  const answer = reader.ask(SUGGEST, null);
  const offer = { kind: 'keep-largest', parts: 2, share: 0.6 } as const;
  last().says({ kind: 'refused', id: idOf(last(), 0), memory: FEW, refusal: { sentence: 'Two parts.', offer, what: 'mesh' } });
  await expect(answer).rejects.toMatchObject({ message: 'Two parts.', offer, what: 'mesh' });
  expect(last().ended).toBe(false);
});

test('a worker that breaks off fails its question alone: a fresh one goes on with the others', async () => {
  const broken = reader.ask(SUGGEST, null);
  const other = reader.ask({ kind: 'sort', files: [] }, null);
  const [first] = FakeWorker.made;
  first?.says({ kind: 'failed', id: idOf(last(), 0), memory: FEW, failure: TRAP });
  await expect(broken).rejects.toThrow(ReaderBroken);
  await expect(broken).rejects.toThrow(/^The computation stopped unexpectedly, perhaps for want of memory/);
  expect(first?.ended).toBe(true);
  expect([modules(last()), kinds(last())]).toEqual([[CORE], ['sort']]);
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: [] });
  expect(await other).toEqual([]);
});

test('an error of the worker itself fails what it was doing', async () => {
  const doing = reader.ask(SUGGEST, null);
  const later = reader.ask({ kind: 'sort', files: [] }, null);
  last().dispatchEvent(Object.assign(new Event('error', { cancelable: true }), { message: 'no memory' }));
  await expect(doing).rejects.toThrow(/could not be started or broke off/);
  expect(kinds(last())).toEqual(['sort']);
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: [] });
  await later;
});

test('a worker whose script does not come is no fault of what was asked', async () => {
  const lost = [reader.ask(SUGGEST, null), reader.ask({ kind: 'sort', files: [] }, null)];
  last().dispatchEvent(new Event('error', { cancelable: true }));
  await Promise.all(lost.map((answer) => expect(answer).rejects.toMatchObject({ failure: { code: 'no-core' } })));
  expect([FakeWorker.made.length, last().ended]).toEqual([1, true]);
  void reader.ask(SUGGEST, null);
  expect([FakeWorker.made.length, kinds(last())]).toEqual([2, ['suggest']]);
});

test('what is left ends the worker, which hears nothing while it reads, and nothing else', async () => {
  const leaving = new AbortController();
  const left = reader.ask(SUGGEST, leaving.signal);
  const kept = reader.ask({ kind: 'sort', files: [] }, new AbortController().signal);
  const [first] = FakeWorker.made;
  leaving.abort();
  await expect(left).rejects.toThrow('left');
  expect(first?.ended).toBe(true);
  expect(kinds(last())).toEqual(['sort']);
  // The answer of the first worker, which was ended, is ignored.
  first?.says({ kind: 'answer', id: 1, memory: FEW, answer: [file('x') as never] });
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: [] });
  expect(await kept).toEqual([]);
  leaving.abort();
  expect(last().ended).toBe(false);
  await expect(reader.ask(SUGGEST, leaving.signal)).rejects.toThrow('left');
});

test('a worker with much memory is let go when it has nothing to do, and the next question has a fresh one', async () => {
  const both = [reader.ask(SUGGEST, null), reader.ask(SUGGEST, null)];
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: 2 ** 30, answer: 'a' });
  expect(last().ended).toBe(false);
  last().says({ kind: 'answer', id: idOf(last(), 1), memory: 2 ** 30, answer: 'b' });
  expect(await Promise.all(both)).toEqual(['a', 'b']);
  expect([FakeWorker.made.length, last().ended]).toEqual([1, true]);
  void reader.ask(SUGGEST, null);
  expect([FakeWorker.made.length, kinds(last())]).toEqual([2, ['suggest']]);
});

test('a module that does not come fails what was asked, and is asked for again by the next question', async () => {
  const source = vi.fn<() => Promise<WebAssembly.Module>>();
  source.mockRejectedValueOnce(new Error('status 404')).mockResolvedValue(CORE);
  const fetching = new AskedWorker<Question>(() => new Worker('reader.js'));
  fetching.use(source);
  expect(source).not.toHaveBeenCalled();
  const lost = [fetching.ask(SUGGEST, null), fetching.ask(SUGGEST, null)];
  await Promise.all(lost.map((answer) => expect(answer).rejects.toThrow(/could not be fetched/)));
  expect(last().ended).toBe(true);
  const answer = fetching.ask(SUGGEST, null);
  await Promise.resolve();
  expect([FakeWorker.made.length, modules(last()), source.mock.calls.length]).toEqual([2, [CORE], 2]);
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: '[]' });
  expect(await answer).toBe('[]');
});

test('files and demos go to one worker with the page’s module, meshes to another with the core', async () => {
  const both = pageReader();
  const [files] = FakeWorker.made;
  void both.ask({ kind: 'sort', files: [] }, null);
  expect(FakeWorker.made).toHaveLength(1);
  void both.ask(SUGGEST, null);
  await Promise.resolve();
  expect([FakeWorker.made.length, modules(files), modules(last())]).toEqual([2, [PAGE], [CORE]]);
  expect([kinds(files ?? last()), kinds(last())]).toEqual([['sort'], ['suggest']]);
});

test('a foreseen demo is begun once, and gives way to any other question', async () => {
  const both = pageReader();
  both.foresee('hands');
  const demo = both.ask({ kind: 'demo', id: 'hands' }, null);
  expect(kinds(last())).toEqual(['demo']);
  last().says({ kind: 'answer', id: idOf(last(), 0), memory: FEW, answer: null });
  expect(await demo).toBeNull();
  both.foresee('poses');
  void both.ask({ kind: 'sort', files: [] }, null);
  expect([FakeWorker.made.length, kinds(last())]).toEqual([2, ['sort']]);
});

test('a foreseen demo that is left ends, too', async () => {
  const both = pageReader();
  const leaving = new AbortController();
  both.foresee('hands');
  const demo = both.ask({ kind: 'demo', id: 'hands' }, leaving.signal);
  leaving.abort();
  await expect(demo).rejects.toThrow('left');
  expect(last().ended).toBe(true);
});

test('a mesh that breaks the reader is refused by its name, and one that is left is not', async () => {
  const both = pageReader();
  const { signal } = new AbortController();
  const reading = readMesh(both, file('big.obj'), {}, signal);
  last().says({ kind: 'failed', id: idOf(last(), 0), memory: FEW, failure: TRAP });
  expect(await reading).toMatchObject({ kind: 'bad', what: 'file', defects: null, sentence: expect.stringMatching(/^big\.obj: The computation stopped/) as string });
  const leaving = new AbortController();
  const left = readMesh(both, file('big.obj'), {}, leaving.signal);
  leaving.abort();
  await expect(left).rejects.toThrow('left');
});
