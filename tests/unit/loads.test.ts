/** Meshes and landmark files that come one after the other. */
import { describe, expect, test } from 'vitest';
import { baseName, landmarkFileOf } from '../../www/store/landmark-file.ts';
import { INITIAL } from '../../www/store/state.ts';
import { after, DONE, FOUR, mesh, READY } from './fixtures.ts';

describe('landmarks stay', () => {
  test('where a mesh fills an empty side', () => {
    const [cat, lion] = [mesh('cat.off'), mesh('lion.off')];
    const state = after(
      INITIAL,
      { kind: 'landmarks', file: { pairs: [[1, 2]] } },
      { kind: 'mesh', side: 0, file: cat },
      { kind: 'mesh', side: 1, file: lion },
    );
    expect(state.pairs.map(({ points }) => points)).toEqual([[1, 2]]);
    expect(state.meshes).toEqual([cat, lion]);
  });

  test('where the mesh is the one that their file names', () => {
    const state = after(READY, { kind: 'mesh', side: 1, file: mesh('lion.off') });
    expect([state.pairs, state.named]).toEqual([FOUR, READY.named]);
  });

  test('on no other mesh', () => {
    const state = after(READY, { kind: 'mesh', side: 1, file: mesh('cat.off') });
    expect([state.pairs, state.named]).toEqual([[], [null, null]]);
  });
});

test('a mesh during a run leaves the run to whoever ends it', () => {
  const state = after(DONE, { kind: 'run-started' }, { kind: 'mesh', side: 0, file: mesh('horse.off') });
  expect(state.job.kind).toBe('running');
});

test('a mesh that a task brings leaves nothing of the last run after the task', () => {
  const task = { sentence: 'Reading the files…' };
  const state = after(
    DONE,
    { kind: 'task-begun', task },
    { kind: 'mesh', side: 0, file: mesh('horse.off') },
    { kind: 'task-ended', task },
  );
  expect(state.job).toEqual({ kind: 'idle' });
});

test('a landmark file without labels and names gives pairs without them', () => {
  const state = after(READY, { kind: 'landmarks', file: { pairs: [[1, 2]] } });
  expect(state.pairs).toEqual([{ points: [1, 2], label: '' }]);
  expect([state.named, state.groundTruth]).toEqual([[null, null], null]);
});

test('the landmarks are saved as they were read', () => {
  const file = {
    source: 'cat.off',
    target: 'lion.off',
    pairs: [
      [1, { face: 3, barycentric: [0.5, 0.25, 0.25] as const }],
      [2, 4],
    ] as const,
    labels: ['nose', ''],
    ground_truth: 'truth.txt',
  };
  expect(landmarkFileOf(after(READY, { kind: 'landmarks', file }))).toEqual(file);
  expect(landmarkFileOf(after(INITIAL, { kind: 'landmarks', file: { pairs: [[1, 2]] } }))).toEqual({ pairs: [[1, 2]] });
});

test('a name loses its folders of either kind', () => {
  expect(['a/b/cat.off', 'a\\b\\cat.off', 'cat.off'].map(baseName)).toEqual(['cat.off', 'cat.off', 'cat.off']);
});
