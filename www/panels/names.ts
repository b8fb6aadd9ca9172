/** The names of the meshes in sentences. */
import type { Side } from '../landmarks.ts';
import type { State } from '../store/state.ts';
import { shortName } from '../store/work.ts';

export const SIDE_NAMES = ['source', 'target'] as const;
export const VIEW_IDS = ['view-source', 'view-target'] as const;

/** A mesh's name in a sentence: its file's name without the ending; `source` or `target` where there is no file, and for demos. */
export function meshName(state: State, side: Side): string {
  const file = state.meshes[side];
  return file === null || state.demo !== null ? SIDE_NAMES[side] : shortName(file.name);
}

/** The name of what the page works on. */
export function documentName(state: State): string {
  if (state.demo !== null) {
    return state.demo.title;
  }
  const [source, target] = state.meshes;
  return source === null && target === null ? 'No meshes yet' : `${meshName(state, 0)} → ${meshName(state, 1)}`;
}
