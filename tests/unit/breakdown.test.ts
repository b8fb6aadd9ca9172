/** Breakdowns of the program, and the report about them. */
import { afterEach, expect, test } from 'vitest';
import { errorOf } from '../../www/app/task.ts';
import { failureOf } from '../../www/compute/messages.ts';
import type { Progress } from '../../www/compute/messages.ts';
import { FileRefused } from '../../www/named-file.ts';
import { breakdownReport, toldBreakdown } from '../../www/store/breakdown.ts';
import { update } from '../../www/store/reducer.ts';
import { READY, RUNNING } from './fixtures.ts';

const HERE = { address: 'https://a.example/conemap/?private#s=1.mine', browser: 'A browser' };
const PROGRESS: Progress = { stage: 'relaxation', sentence: 'Relaxing the map', share: 0.5, residual: null, energy: 5 };

afterEach(() => {
  Reflect.deleteProperty(globalThis, 'conemapPanic');
});

test('a run that breaks off has a report of sizes, options and place, and nothing of the files', () => {
  Reflect.set(globalThis, 'conemapPanic', 'panicked at src/a.rs:1: no such piece');
  const failure = failureOf(new WebAssembly.RuntimeError('unreachable'));
  expect(failure).toMatchObject({ code: 'trap', message: 'panicked at src/a.rs:1: no such piece' });
  const state = update({ ...READY, job: { ...RUNNING, progress: PROGRESS } }, { kind: 'run-failed', sentence: 'It broke off.', failure });
  const breakdown = toldBreakdown(state);
  expect(breakdown).toMatchObject({ during: 'Relaxing the map, 50 %' });
  const report = breakdown === null ? '' : breakdownReport(state, breakdown, HERE);
  for (const told of ['Failure: trap: panicked at src/a.rs:1', 'During: Relaxing the map, 50 %', 'Pairs: 4', '"method":"relaxed"', 'A browser']) {
    expect(report).toContain(told);
  }
  expect(report).toContain('Page: https://a.example/conemap/\n');
  for (const { name } of READY.meshes.filter((file) => file !== null)) {
    expect(report).not.toContain(name);
  }
  expect(report).not.toMatch(/private|mine/u);
});

test('memory that ran out says nothing, and is told as the browser tells it', () => {
  expect(failureOf(new WebAssembly.RuntimeError('unreachable'))).toMatchObject({ code: 'trap', message: 'unreachable' });
});

test('what was foreseen has none, and another sentence takes the report away', () => {
  const refused = update(READY, { kind: 'error', sentence: 'No.', failure: { code: 'mesh', message: 'no' } });
  expect(toldBreakdown(refused)).toBeNull();
  const broken = update(READY, errorOf(new Error('no memory')));
  expect(toldBreakdown(broken)).not.toBeNull();
  expect(toldBreakdown(update(broken, { kind: 'error-closed' }))).toBeNull();
  expect(toldBreakdown(update(broken, { kind: 'error', sentence: 'Another file.' }))).toBeNull();
});

test('a file that is refused for what is not its fault has a report, too', () => {
  const failure = { code: 'worker', message: 'broke off' };
  expect(toldBreakdown(update(READY, errorOf(new FileRefused('a.obj: it broke off.', { failure }))))).toMatchObject({ failure });
  expect(toldBreakdown(update(READY, errorOf(new FileRefused('a.obj: no faces.'))))).toBeNull();
});
