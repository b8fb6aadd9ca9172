/** What the views show instead of the meshes: refused meshes, defects, a preview of the map, coarser meshes. */
import { SIDES } from '../landmarks.ts';
import type { StageFrame, Stops } from '../method/hands.ts';
import { shownDefects } from '../store/defects.ts';
import { shownPreview } from '../store/preview.ts';
import type { State } from '../store/state.ts';
import { upOf } from '../store/work.ts';
import type { Viewer } from '../wasm/page.js';

/** Shows defects: a refused mesh instead of the side's own, or marks over the side's mesh where it was repaired. */
export function showDefects(viewer: Viewer, state: State, previous: State | null): void {
  for (const side of SIDES) {
    const shown = shownDefects(state, side);
    const isSameMesh = previous?.meshes[side] === state.meshes[side];
    if (previous !== null && isSameMesh && shownDefects(previous, side) === shown) {
      continue;
    }
    const refused = state.refused?.meshes.find((mesh) => mesh.side === side);
    if (shown === null) {
      viewer.clearDefects(side);
    } else if (refused === undefined) {
      viewer.showRepaired(side, shown.found);
    } else {
      viewer.showRefused(side, shown.found, upOf(refused.file.name));
    }
  }
}

/** Shows the triangles that stopped a flow over the mesh of their side; on other sides the defects of the mesh. */
export function showStops(viewer: Viewer, state: State, stops: Stops | null): void {
  showDefects(viewer, state, null);
  for (const side of SIDES) {
    const found = stops?.[side] ?? null;
    if (found !== null) {
      viewer.showRepaired(side, found);
    }
  }
}

/** Shows the preview of the map that is being made, where there is one. */
export function showPreview(viewer: Viewer, state: State): void {
  const preview = shownPreview(state);
  if (preview === null) {
    viewer.clearPreview();
  } else {
    viewer.setPreview(preview);
  }
}

/** The stages that each renderer has. */
const STAGES = new WeakMap<Viewer, StageFrame['sides']>();

const NO_PLACES = new Float32Array();

/** Shows a stage of the simplification of both meshes; `null` shows the meshes as they are. */
export function showStage(viewer: Viewer, frame: StageFrame | null): void {
  if (frame === null) {
    STAGES.delete(viewer);
    viewer.clearStages();
    return;
  }
  const isOther = STAGES.get(viewer) !== frame.sides;
  STAGES.set(viewer, frame.sides);
  for (const side of SIDES) {
    if (isOther) {
      viewer.setStage(side, frame.sides[side].positions, frame.sides[side].triangles);
    }
    viewer.setTrail(side, frame.trails[side] ?? NO_PLACES);
  }
}
