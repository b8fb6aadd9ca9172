/** The job of the page, which does one thing at a time: tasks, runs, and when a run can start. */
import { describe, expect, test } from 'vitest';
import { canRun } from '../../www/store/readiness.ts';
import type { Stage } from '../../www/report.ts';
import type { State } from '../../www/store/state.ts';
import { after, DONE, FOUR, OUTPUT, READY, REFUSAL, REPORT, RESULT, RUNNING } from './fixtures.ts';

const [FIRST, SECOND] = [{ sentence: 'Reading the files…' }, { sentence: 'Reading the files…' }];
const relaxed = (energy: number | null, stage: Stage = 'relaxation') =>
  ({ kind: 'run-progress', progress: { stage, sentence: 'Relaxing the map', share: 0, residual: null, energy } }) as const;

describe('a run can start', () => {
  test('with two meshes and four pairs, before and after other runs', () => {
    expect(canRun(READY)).toBe(true);
    expect(canRun(DONE)).toBe(true);
    expect(canRun({ ...READY, job: { kind: 'error' } })).toBe(true);
  });

  test.each<[string, Partial<State>]>([
    ['the core', { ready: false }],
    ['a source', { meshes: [null, READY.meshes[1]] }],
    ['a target', { meshes: [READY.meshes[0], null] }],
    ['a fourth pair', { pairs: FOUR.slice(1) }],
  ])('not without %s', (_, lacking) => {
    expect(canRun({ ...READY, ...lacking })).toBe(false);
  });

  test('not during another run', () => {
    expect(canRun(after(READY, { kind: 'run-started' }))).toBe(false);
  });

  test('not while the page is busy, and again after it', () => {
    const busy = after(READY, { kind: 'task-begun', task: FIRST });
    expect(canRun(busy)).toBe(false);
    expect(canRun(after(busy, { kind: 'task-ended', task: FIRST }))).toBe(true);
  });
});

describe('a proof', () => {
  const other = { ...RESULT };

  test('that comes after another map was asked about is left out', () => {
    const asked = after(DONE, { kind: 'proof-begun', of: RESULT }, { kind: 'proof-begun', of: other });
    expect(after(asked, { kind: 'proof-done', of: RESULT, answer: REFUSAL }).proof).toEqual({ of: other, answer: null });
  });

  test('that could not be made can be asked for again', () => {
    const asked = after(DONE, { kind: 'proof-begun', of: RESULT });
    expect(after(asked, { kind: 'proof-done', of: RESULT, answer: null }).proof).toBeNull();
  });
});

describe('a task', () => {
  test('takes the place of another, whose end then says nothing', () => {
    const state = after(
      DONE,
      { kind: 'task-begun', task: FIRST },
      { kind: 'task-begun', task: SECOND },
      { kind: 'task-ended', task: FIRST },
    );
    expect(state.job).toEqual({ kind: 'busy', task: SECOND, then: { kind: 'done' } });
    expect(state.job.kind === 'busy' && state.job.task).toBe(SECOND);
    expect(after(state, { kind: 'task-ended', task: SECOND }).job).toEqual({ kind: 'done' });
  });

  test('does not begin during a run', () => {
    const state = after(READY, { kind: 'run-started' }, { kind: 'task-begun', task: FIRST });
    expect(state.job).toEqual(RUNNING);
    expect(after(state, { kind: 'task-ended', task: FIRST }).job).toEqual(RUNNING);
  });
});

describe('a run', () => {
  const started = after(READY, { kind: 'run-started' });

  test('records each fall of the energy, apart for each relaxation', () => {
    const state = after(
      started,
      relaxed(9, 'base_domain'),
      { kind: 'run-relaxes' },
      relaxed(6),
      relaxed(6.5),
      relaxed(null),
      relaxed(5),
      { kind: 'run-relaxes' },
      relaxed(5.5),
    );
    expect(state.job).toMatchObject({ energies: [[6, 5], [5.5]], progress: { energy: 5.5 } });
  });

  test('cannot be asked to finish once there is only the certificate left, but stays asked', () => {
    const possible = after(started, { kind: 'run-finishable' });
    expect(after(possible, relaxed(5)).job).toMatchObject({ finish: 'possible' });
    expect(after(possible, relaxed(null, 'certificate')).job).toMatchObject({ finish: 'no' });
    expect(after(possible, { kind: 'run-finish' }, relaxed(null, 'certificate')).job).toMatchObject({ finish: 'asked' });
  });

  test('that ends without a map leaves the last one', () => {
    const again = after(DONE, { kind: 'run-started' });
    expect(again.result).toBe(DONE.result);
    expect(after(again, { kind: 'run-cancelled' })).toMatchObject({ job: { kind: 'done' }, result: DONE.result });
    expect(after(again, { kind: 'run-failed', sentence: 'No map was found.' })).toMatchObject({
      job: { kind: 'error' },
      result: DONE.result,
    });
  });

  test('that is over hears nothing more', () => {
    const over = after(started, { kind: 'run-done', output: OUTPUT, report: REPORT });
    for (const event of [relaxed(5), { kind: 'run-relaxes' }, { kind: 'run-finishable' }, { kind: 'run-finish' }] as const) {
      expect(after(over, event)).toBe(over);
    }
  });
});
