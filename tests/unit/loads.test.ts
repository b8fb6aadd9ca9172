/** Meshes and landmark files that are opened one after the other. */
import { describe, expect, test } from 'vitest';
import { baseName, landmarkFileOf } from '../../www/store/landmark-file.ts';
import { INITIAL } from '../../www/store/state.ts';
import { giverOf } from '../../www/store/work.ts';
import { after, DEMO, DONE, FOUR, mesh, pair, READY, suggestion } from './fixtures.ts';

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

  test('on no other mesh: their partners wait for new points', () => {
    const state = after(READY, { kind: 'mesh', side: 1, file: mesh('cat.off') });
    expect(state.pairs).toEqual([pair(1, 0, null), pair(2, 1, null), pair(3, 2, null), pair(4, 3, null)]);
    expect(state.named).toEqual(['cat.off', null]);
    expect(state.toast).toEqual({
      sentence: '4 landmark pairs lost a point with its mesh; the partners wait for new ones.',
      undo: true,
    });
    const none = after(state, { kind: 'mesh', side: 0, file: mesh('lion.off') });
    expect([none.pairs, none.named]).toEqual([[], [null, null]]);
  });

  test('not where they are a demo’s', () => {
    const state = after({ ...READY, demo: DEMO }, { kind: 'mesh', side: 1, file: mesh('cat.off') });
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
  expect(state.pairs).toEqual([{ ...pair(5, 1, 2), number: 1 }]);
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

test('half pairs are in no file', () => {
  const state = after(READY, { kind: 'point-picked', side: 0, point: 7 });
  expect(landmarkFileOf(state).pairs).toHaveLength(4);
});

test('a mirror image keeps ids, labels, locks and half pairs', () => {
  const before = { ...READY, pairs: [{ ...pair(7, 1, 2, 'nose'), locked: true }, pair(8, 3, null), pair(9, null, 5)] };
  const state = after(before, { kind: 'mirrored', file: mesh('lion (mirrored).obj'), points: [12, null, 15] });
  expect(state.pairs).toEqual([{ ...pair(7, 1, 12, 'nose'), locked: true }, pair(8, 3, null), pair(9, null, 15)]);
  expect(after(state, { kind: 'undo' }).pairs).toBe(before.pairs);
});

test('what is known of a mesh goes with it: suggestions, camera, which way is up', () => {
  const before = after(
    READY,
    { kind: 'suggested', side: 0, suggestions: [suggestion(1, 'A')] },
    { kind: 'camera-moved', side: 0, camera: [1, 2, 3] },
    { kind: 'up', side: 0, axis: '-x' },
    { kind: 'style', style: { morph: 0.5, cones: true } },
  );
  const swapped = after(before, { kind: 'swap-meshes' });
  expect(swapped.suggestions).toEqual([[], [suggestion(1, 'A')]]);
  expect([swapped.ui.cameras, swapped.up]).toEqual([
    [null, [1, 2, 3]],
    ['y', '-x'],
  ]);
  // The shapes are exchanged, so the source is shown in its own shape again.
  const style = { ...before.ui.style, morph: 0 };
  expect(swapped.ui.style).toEqual(style);
  const undone = after(swapped, { kind: 'undo' });
  expect(undone).toMatchObject({ suggestions: before.suggestions, ui: { ...before.ui, style }, up: before.up });
});

test('a mesh that comes back stands as it stood last', () => {
  const state = after(
    READY,
    { kind: 'pair-deleted', id: 1 },
    { kind: 'up', side: 1, axis: 'z' },
    { kind: 'mesh', side: 1, file: mesh('horse.stl') },
    { kind: 'up', side: 1, axis: 'x' },
  );
  const back = after(state, { kind: 'undo' });
  expect(back.up).toEqual(['y', 'z']);
  // The step before was made while another axis of the mesh pointed up.
  expect(after(back, { kind: 'undo' }).up).toEqual(['y', 'z']);
});

test('a name loses its folders of either kind', () => {
  expect(['a/b/cat.off', 'a\\b\\cat.off', 'cat.off'].map(baseName)).toEqual(['cat.off', 'cat.off', 'cat.off']);
});

describe('colours of a file', () => {
  const coloured = { ...mesh('cat.ply'), look: 'colours' } as const;

  test('are shown where nothing else was chosen', () => {
    const state = after(INITIAL, { kind: 'mesh', side: 1, file: coloured });
    expect(state.ui.style.surface).toBe('look');
    const chosen = after(INITIAL, { kind: 'style', style: { surface: 'distortion' } }, { kind: 'mesh', side: 1, file: coloured });
    expect(chosen.ui.style.surface).toBe('distortion');
    expect(after(INITIAL, { kind: 'mesh', side: 1, file: { ...coloured, look: 'places' } }).ui.style.surface).toBe('shaded');
  });

  test('are carried from the target, or else from the source', () => {
    const plain = mesh('horse.obj');
    const givers = ([[plain, coloured], [coloured, plain], [coloured, coloured], [plain, plain], [null, plain]] as const).map((meshes) =>
      giverOf({ meshes }),
    );
    expect(givers).toEqual([1, 0, 1, null, null]);
  });
});
