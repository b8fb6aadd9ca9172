/** Brings everything that was about the earlier work in line with other work on the page. */
import { SIDES } from '../landmarks.ts';
import { heldMeshes } from './history.ts';
import { settled } from './job.ts';
import { stillMatching } from './matching.ts';
import { changesBetween, shownResult } from './staleness.ts';
import type { State } from './state.ts';

const NONE: State['findings'] = [];

/** The id where a pair still has it; else `null`. */
function present(state: State, id: number | null): number | null {
  return state.pairs.some((pair) => pair.id === id) ? id : null;
}

/** Whether the findings of the last run are about the landmarks and meshes on the page. */
function areAbout(state: State): boolean {
  const changes = state.found === null ? null : changesBetween(state.found.inputs, state);
  return changes === null || [changes.meshes, changes.placed, changes.moved, changes.removed].every((list) => list.length === 0);
}

/** The state with the findings of the last run, where they are about it. */
export function withFindings(state: State): State {
  const findings = state.found !== null && areAbout(state) ? state.found.doubts : NONE;
  return findings === state.findings || findings.length + state.findings.length === 0 ? state : { ...state, findings };
}

/** Whether these meshes are on the page, or a step leads back to them. */
function areReachable(state: State, meshes: State['meshes']): boolean {
  if (SIDES.every((side) => meshes[side] === state.meshes[side])) {
    return true;
  }
  const held = heldMeshes(state.history, state);
  return meshes.every((file) => file === null || held.has(file));
}

/** What belongs to meshes that can be reached; else `null`. */
function reachable<T>(state: State, one: T | null, meshesOf: (one: T) => State['meshes']): T | null {
  return one !== null && areReachable(state, meshesOf(one)) ? one : null;
}

/** The state made consistent with its work, which was another one in `before`. */
export function inLine(state: State, before: State): State {
  const selected = present(state, state.ui.selected);
  const hovered = present(state, state.ui.hovered);
  const isSelected = selected === state.ui.selected && hovered === state.ui.hovered;
  const pruned = isSelected ? state : { ...state, ui: { ...state.ui, selected, hovered } };
  const matching = stillMatching(pruned.matching, pruned, before);
  const result = reachable(pruned, pruned.result, ({ inputs }) => inputs.meshes);
  const mapless = reachable(pruned, pruned.mapless, (meshes) => meshes);
  const next = withFindings({ ...pruned, matching, result, mapless });
  if (next.meshes === before.meshes) {
    return next;
  }
  // What is known of a mesh moves with it to the other side.
  const follow = <T>(both: readonly [T, T], none: T): readonly [T, T] => {
    const of = (file: State['meshes'][0]): T => {
      const side = SIDES.find((candidate) => file !== null && before.meshes[candidate] === file);
      return side === undefined ? none : both[side];
    };
    return [of(next.meshes[0]), of(next.meshes[1])];
  };
  const isUnknown = before.leftRight.planes.every((plane) => plane === null);
  // A kept session brings its own cameras and style.
  const { cameras, style } = next.ui;
  return {
    ...next,
    suggestions: follow(before.suggestions, []),
    leftRight: isUnknown ? next.leftRight : { ...next.leftRight, planes: follow(before.leftRight.planes, null) },
    examined: before.examined.every((one) => one === null) ? before.examined : follow(before.examined, null),
    ui: {
      ...next.ui,
      cameras: cameras === before.ui.cameras ? follow(cameras, null) : cameras,
      // A new map is first seen in the own shapes of its meshes.
      style: style === before.ui.style && style.morph > 0 ? { ...style, morph: 0 } : style,
    },
    job: settled(next.job, shownResult(next) !== null),
  };
}
