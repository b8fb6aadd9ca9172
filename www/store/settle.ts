/** What follows from other work on the page: what spoke of the work before it is brought in line. */
import { SIDES } from '../landmarks.ts';
import { heldMeshes } from './history.ts';
import { settled } from './job.ts';
import { stillMatching } from './matching.ts';
import { changesBetween, shownResult } from './staleness.ts';
import type { State } from './state.ts';

const NONE: State['findings'] = [];

/** The id where it is still a pair's. */
function present(state: State, id: number | null): number | null {
  return state.pairs.some((pair) => pair.id === id) ? id : null;
}

/** Whether the doubts of the last run are about the landmarks and meshes on the page. */
function areAbout(state: State): boolean {
  const changes = state.found === null ? null : changesBetween(state.found.inputs, state);
  return changes === null || [changes.meshes, changes.placed, changes.moved, changes.removed].every((list) => list.length === 0);
}

/** The state with its doubts where they are about it. */
export function withFindings(state: State): State {
  const findings = state.found !== null && areAbout(state) ? state.found.doubts : NONE;
  return findings === state.findings || findings.length + state.findings.length === 0 ? state : { ...state, findings };
}

/** The last map, unless its meshes can come back by no step. */
function reachableResult(state: State): State['result'] {
  const { result } = state;
  if (result === null || shownResult(state) !== null) {
    return result;
  }
  const held = heldMeshes(state.history, state);
  return result.inputs.meshes.every((file) => file === null || held.has(file)) ? result : null;
}

/** The state in line with its work, which was another one before. */
export function inLine(state: State, before: State): State {
  const selected = present(state, state.ui.selected);
  const hovered = present(state, state.ui.hovered);
  const isSelected = selected === state.ui.selected && hovered === state.ui.hovered;
  const pruned = isSelected ? state : { ...state, ui: { ...state.ui, selected, hovered } };
  const matching = stillMatching(pruned.matching, pruned, before);
  const next = withFindings({ ...pruned, matching, result: reachableResult(pruned) });
  if (next.meshes === before.meshes) {
    return next;
  }
  // What is known of a mesh goes with it to the other side.
  const follow = <T>(both: readonly [T, T], none: T): readonly [T, T] => {
    const of = (file: State['meshes'][0]): T => {
      const side = SIDES.find((candidate) => file !== null && before.meshes[candidate] === file);
      return side === undefined ? none : both[side];
    };
    return [of(next.meshes[0]), of(next.meshes[1])];
  };
  const isUnknown = before.leftRight.planes.every((plane) => plane === null);
  // A session that comes back brings its cameras and its style along.
  const { cameras, style } = next.ui;
  return {
    ...next,
    suggestions: follow(before.suggestions, []),
    leftRight: isUnknown ? next.leftRight : { ...next.leftRight, planes: follow(before.leftRight.planes, null) },
    examined: before.examined.every((one) => one === null) ? before.examined : follow(before.examined, null),
    ui: {
      ...next.ui,
      cameras: cameras === before.ui.cameras ? follow(cameras, null) : cameras,
      // Another map is seen in the shapes of its own meshes first.
      style: style === before.ui.style && style.morph > 0 ? { ...style, morph: 0 } : style,
    },
    job: settled(next.job, shownResult(next) !== null),
  };
}
