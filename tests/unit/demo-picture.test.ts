/** A demo may come with a style of its own, which goes with it. */
import { expect, test } from 'vitest';
import type { Demo, State } from '../../www/store/state.ts';
import { INITIAL } from '../../www/store/state.ts';
import { update } from '../../www/store/reducer.ts';
import { mesh } from './fixtures.ts';

const CONE: Demo = { id: 'ball-cone', title: 'Ball and cone', sentence: 'A ball and a cone' };
const OTHER: Demo = { id: 'hands', title: 'Two hands', sentence: 'One hand open and grasping' };

function opened(state: State, demo: Demo): State {
  const withMesh = update(state, { kind: 'mesh', side: 0, file: mesh('source.obj') });
  return update(withMesh, { kind: 'demo', demo });
}

test('the cone shows its texture and where that is cut', () => {
  expect(opened(INITIAL, CONE).ui.style).toEqual({ ...INITIAL.ui.style, surface: 'checkerboard', textureBoundary: true });
});

test('the next demo is shown as it would be by itself', () => {
  expect(opened(opened(INITIAL, CONE), OTHER).ui.style).toEqual(INITIAL.ui.style);
});

test('what was chosen meanwhile stays', () => {
  const chosen = update(opened(INITIAL, CONE), { kind: 'style', style: { surface: 'distortion', cones: true } });
  expect(opened(chosen, OTHER).ui.style).toEqual({ ...INITIAL.ui.style, surface: 'distortion', cones: true });
});
