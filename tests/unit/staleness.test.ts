/** When the shown map is no longer that of the landmarks and options on the page. */
import { describe, expect, test } from 'vitest';
import type { RunOptions } from '../../www/report.ts';
import { hasItsCones, isStale } from '../../www/store/staleness.ts';
import { after, DONE, READY } from './fixtures.ts';

const OTHER: RunOptions = { method: 'thesis', base: 'qem', cones: 'uniform', class: 'runner-up', ownCones: 0 };

describe('a result is stale', () => {
  test('neither at first nor without a result', () => {
    expect(isStale(DONE)).toBe(false);
    expect(isStale(READY)).toBe(false);
  });

  test.each(Object.keys(OTHER) as (keyof RunOptions)[])('after another choice of %s, until it is taken back', (key) => {
    const changed = after(DONE, { kind: 'options', options: { [key]: OTHER[key] } });
    expect(isStale(changed)).toBe(true);
    expect(isStale(after(changed, { kind: 'options', options: { [key]: DONE.options[key] } }))).toBe(false);
  });

  test('after a change of the pairs, until it is undone', () => {
    const picks = [
      { kind: 'picked', side: 0, point: 7 },
      { kind: 'picked', side: 1, point: 17 },
    ] as const;
    for (const events of [
      [{ kind: 'pair-deleted', index: 3 }],
      [{ kind: 'targets-exchanged', indices: [0, 1] }],
      [{ kind: 'pairs-cleared' }],
      picks,
    ] as const) {
      const changed = after(DONE, ...events);
      expect(isStale(changed)).toBe(true);
      expect(isStale(after(changed, { kind: 'undo' }))).toBe(false);
    }
  });

  test('neither by a label nor by a point that waits', () => {
    expect(isStale(after(DONE, { kind: 'pair-labelled', index: 0, label: 'nose' }))).toBe(false);
    expect(isStale(after(DONE, { kind: 'picked', side: 0, point: 7 }))).toBe(false);
  });
});

test('a new pair leaves the cones of the others in place, a deleted one does not', () => {
  expect(hasItsCones(READY)).toBe(false);
  expect(hasItsCones(DONE)).toBe(true);
  const more = after(DONE, { kind: 'picked', side: 0, point: 7 }, { kind: 'picked', side: 1, point: 17 });
  expect(hasItsCones(more)).toBe(true);
  expect(hasItsCones(after(DONE, { kind: 'pair-deleted', index: 3 }))).toBe(false);
  expect(hasItsCones(after(DONE, { kind: 'pair-deleted', index: 0 }))).toBe(false);
});
