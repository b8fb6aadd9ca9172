/** Brings the buffers of a map to the renderer, each when the picture first needs it. */
import type { Way } from '../compute/saved-messages.ts';
import type { Flows } from '../compute/watch-messages.ts';
import { scaleOf } from '../heat/scales.ts';
import type { VertexHeat } from '../heat/values.ts';
import { heatByVertex, valuesByPoint } from '../heat/values.ts';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import type { FlowFrame } from '../method/hands.ts';
import type { BasePart } from '../method/parts.ts';
import { litBy } from '../method/parts.ts';
import type { ComparedMap, FlowHeat, MapHeat, Result, Style, TexturePicture } from '../store/state.ts';
import { isFlowHeat, isMapHeat } from '../store/surfaces.ts';
import type { SurfaceStyle, Viewer } from '../wasm/page.js';
import type { Known } from './probe.ts';

/** The sides on which a style needs the map's own triangles; on the other sides the mesh itself can show the style. */
const OVERLAYS: Readonly<Record<Style['surface'], readonly Side[]>> = {
  shaded: [],
  // The look that the map carries has triangles of its own.
  look: [],
  // A style that depends only on the place on the target can be shown by the target's mesh.
  pattern: [0],
  colours: [0],
  checkerboard: SIDES,
  circles: SIDES,
  ribbons: SIDES,
  coordinates: SIDES,
  picture: SIDES,
  distortion: SIDES,
  angles: SIDES,
  areas: SIDES,
  truth: SIDES,
  // Values at vertices are shown by the meshes themselves.
  factor: [],
  curvature: [],
  'flat-curvature': [],
};

/** The surface that the renderer draws: the checkerboard instead of a picture that is missing. */
export function drawnSurface(surface: Style['surface'], picture: TexturePicture | null): SurfaceStyle {
  if (isFlowHeat(surface)) {
    return 'shaded';
  }
  if (isMapHeat(surface)) {
    return scaleOf(surface).colours;
  }
  return surface === 'picture' && picture === null ? 'checkerboard' : surface;
}

const NO_VALUES = new Float32Array();

/** The places of a map's points on the scale of a heat map; empty without a heat map. */
function placesOf(output: ComparedMap['output'], heat: MapHeat | null): Float32Array {
  return heat === null ? NO_VALUES : valuesByPoint(output, heat).map(scaleOf(heat).place);
}

/** Knows which buffers one renderer has. */
export class Picture {
  #result: Result | null = null;
  #overlays = new Set<Side>();
  /** The heat map whose places the overlays have; `null` where they have none. */
  #heat: MapHeat | null = null;
  #places: Float32Array = NO_VALUES;
  /** The values of the shown heat map at the points of the map; `null` where no such heat map is shown. */
  #values: Float32Array | null = null;
  /** The heat map of the vertices that is shown, and the flows that it is about. */
  #vertices: { readonly flows: Flows; readonly heat: FlowHeat; readonly shown: VertexHeat } | null = null;
  #lines = false;
  #seams = false;
  #carried = false;
  #giver: Side | null = null;
  #map = false;
  #patches = false;
  #lit: BasePart | null = null;
  #isMorphed = false;
  /** The known ways of maps to the target's shape; they stay when the renderer is replaced. */
  readonly #ways = new WeakMap<Result['output'], Way>();
  #way = false;
  #compared: ComparedMap | null = null;
  /** The heat map whose places the renderer has for the other map, or `none`; `null` where it does not have that map. */
  #comparedHeat: MapHeat | 'none' | null = null;
  #comparedLines = false;
  #moment: FlowFrame['places'] | null = null;
  #radii: FlowFrame['radii'] = null;
  /** Whether the base domain is looked at, whose parts light up on the meshes. */
  wantsPatches = false;

  /** Whether the source is shown in another shape than its own, so that no place on it is where its mesh has it. */
  get isMorphed(): boolean {
    return this.#isMorphed;
  }

  /** Takes another map, or none, and drops the buffers of the last one. `giver` is the side whose look the map carries. */
  take(viewer: Viewer, result: Result | null, giver: Side | null): void {
    viewer.clearResult();
    this.#result = result;
    this.#overlays = new Set();
    this.#lines = false;
    this.#seams = false;
    this.#carried = false;
    this.#giver = giver;
    this.#map = false;
    this.#patches = false;
    this.#lit = null;
    this.#isMorphed = false;
    this.#way = false;
    this.#compared = null;
    this.#moment = null;
    this.#heat = null;
    this.#places = NO_VALUES;
    this.#values = null;
    this.#vertices = null;
  }

  /** Lets the second view show another map from now on; `null` shows its own side. */
  compare(viewer: Viewer, map: ComparedMap | null): void {
    this.#compared = map;
    this.#comparedHeat = null;
    this.#comparedLines = false;
    viewer.clearCompared();
  }

  /** Brings the buffers of the other map that a style needs. */
  #bringCompared(viewer: Viewer, { output }: ComparedMap, style: Style): void {
    const [source, target] = output.sides;
    if (this.#comparedHeat !== (this.#heat ?? 'none')) {
      viewer.setCompared(source.positions, source.normals, output.uvs, placesOf(output, this.#heat), output.triangles, target.positions, target.normals);
      this.#comparedHeat = this.#heat ?? 'none';
      this.#comparedLines = false;
    }
    if (style.patchLines && !this.#comparedLines) {
      viewer.setComparedLines(source.linePoints, source.lineStarts);
      this.#comparedLines = true;
    }
  }

  /**
   * Lets the points of a map move on this way from now on. Triangles of the source that the renderer has move straight, so they are brought
   * again.
   */
  takeWay(viewer: Viewer, output: Result['output'], way: Way): void {
    this.#ways.set(output, way);
    if (this.#result?.output !== output) {
      return;
    }
    const isCarried = this.#carried;
    this.#overlays.delete(0);
    this.#carried = false;
    if (isCarried) {
      this.#bringLook(viewer, output);
    }
    if (this.#isMorphed) {
      this.bringOverlay(viewer, 0);
    }
  }

  /** Brings the way of the map, where it is known. It must come before the triangles that use it. */
  #bringWay(viewer: Viewer, output: Result['output']): void {
    const way = this.#ways.get(output);
    if (way !== undefined && !this.#way) {
      viewer.setWay(way.laid, way.range, way.bends);
      this.#way = true;
    }
  }

  /** Brings the map's triangles on one side; returns whether there is a map. */
  bringOverlay(viewer: Viewer, side: Side): boolean {
    const result = this.#result;
    if (result !== null) {
      this.#bringWay(viewer, result.output);
    }
    if (result !== null && !this.#overlays.has(side)) {
      const { uvs, triangles, sides } = result.output;
      const { positions, normals } = sides[side];
      viewer.setOverlay(side, positions, normals, uvs, this.#places, triangles, sides[1].positions, sides[1].normals);
      this.#overlays.add(side);
    }
    return result !== null;
  }

  /** Brings the map's triangles in the look that the map carries: the target's, or else the source's. */
  #bringLook(viewer: Viewer, output: Result['output']): void {
    const { sides, triangles, faces } = output;
    const giver = this.#giver;
    if (this.#carried || giver === null || faces[giver].length === 0) {
      return;
    }
    this.#bringWay(viewer, output);
    const [{ positions: places }, target] = [sides[giver], sides[1]];
    // The source's own mesh, where it is the giver, needs its triangles, too, to move to the target's shape.
    for (const side of giver === 0 ? SIDES : ([0] as const)) {
      const { positions, normals } = sides[side];
      viewer.setCarriedLook(side, giver, positions, normals, places, target.positions, target.normals, triangles, faces[giver]);
    }
    this.#carried = true;
  }

  /** Has the overlays brought again where another heat map is shown than the one that they have. */
  #tell(output: Result['output'], surface: Style['surface']): void {
    const heat = isMapHeat(surface) ? surface : null;
    if (heat !== null && heat !== this.#heat) {
      this.#heat = heat;
      this.#places = placesOf(output, heat);
      this.#overlays.clear();
    }
    this.#values = heat === null ? null : valuesByPoint(output, heat);
  }

  /** The values from which questions about places are answered. */
  get known(): Known {
    const isFlow = this.#moment !== null;
    return {
      distortion: this.#result?.output.distortion ?? NO_VALUES,
      values: isFlow ? null : this.#values,
      valueAt: isFlow ? null : (this.#vertices?.shown.scale.value ?? null),
    };
  }

  /** Brings the buffers that a style needs. */
  bring(viewer: Viewer, style: Style): void {
    const result = this.#result;
    if (result === null) {
      return;
    }
    const { output } = result;
    if (style.surface === 'look') {
      this.#bringLook(viewer, output);
    }
    this.#tell(output, style.surface);
    for (const side of OVERLAYS[style.surface]) {
      this.bringOverlay(viewer, side);
    }
    if (this.#compared !== null) {
      this.#bringCompared(viewer, this.#compared, style);
    }
    if (style.patchLines && !this.#lines) {
      for (const side of SIDES) {
        viewer.setLines(side, output.sides[side].linePoints, output.sides[side].lineStarts);
      }
      this.#lines = true;
    }
    if (style.textureBoundary && !this.#seams && output.distortion.length > 0) {
      for (const side of SIDES) {
        viewer.setSeams(side, output.sides[side].positions, output.uvs, output.triangles);
      }
      this.#seams = true;
    }
  }

  /** Shows the source on its way to the target's shape, where there is a map: 0 is the source's shape, 1 the target's. */
  morph(viewer: Viewer, share: number): void {
    const isThere = share > 0 && this.bringOverlay(viewer, 0);
    viewer.setMorph(isThere ? share : 0);
    this.#isMorphed = isThere;
  }

  /** Brings the map, so that it can be asked about single places; returns whether there is one. */
  bringMap(viewer: Viewer): boolean {
    if (this.#result !== null && !this.#map) {
      const { sides, triangles } = this.#result.output;
      viewer.setMap(sides[0].positions, sides[1].positions, triangles);
      this.#map = true;
    }
    return this.#map;
  }

  /** Brings the patches where they are wanted; returns whether there are any. */
  bringPatches(viewer: Viewer): boolean {
    const base = this.#result?.output.base ?? null;
    if (this.#result !== null && base !== null && this.wantsPatches && !this.#patches) {
      for (const side of SIDES) {
        const { patchPoints, patchTriangles, patchStarts } = base.shapes[side];
        const { linePoints, lineStarts } = this.#result.output.sides[side];
        viewer.setPatches(side, patchPoints, patchTriangles, patchStarts, linePoints, lineStarts);
      }
      this.#patches = true;
    }
    return this.#patches;
  }

  /** Lights up a part of the base domain on both meshes, in place of the last one; returns whether it is another part. */
  light(viewer: Viewer, part: BasePart | null): boolean {
    const isOther = this.#lit?.kind !== part?.kind || this.#lit?.index !== part?.index;
    const base = this.#result?.output.base ?? null;
    if (!isOther || base === null || !this.bringPatches(viewer)) {
      return false;
    }
    this.#lit = part;
    const { patch, lines } = litBy(base, part);
    viewer.light(patch ?? undefined, Uint32Array.from(lines));
    return true;
  }

  /** Shows the flows on both meshes instead of the style's picture; `null` shows the style's picture again. */
  showFlow(viewer: Viewer, frame: FlowFrame | null): void {
    if (frame === null) {
      this.#moment = null;
      this.#layHeat(viewer);
      return;
    }
    const isOther = this.#moment !== frame.places || this.#radii !== frame.radii;
    if (isOther) {
      for (const side of SIDES) {
        viewer.setFactors(side, frame.places[side].from, frame.places[side].to);
      }
      this.#moment = frame.places;
      this.#radii = frame.radii;
    }
    // Circles cannot be blended; they belong to one moment.
    viewer.blendFactors(frame.radii === null ? frame.share : 0);
    if (isOther && frame.radii !== null) {
      for (const side of SIDES) {
        viewer.setCircles(side, frame.radii[side]);
      }
    }
  }

  /** Shows a heat map of the vertices instead of the style's picture, where the surface is one and its flows are computed. */
  showHeat(viewer: Viewer, surface: Style['surface'], flows: Flows | null): void {
    const heat = flows !== null && isFlowHeat(surface) ? surface : null;
    if (heat === (this.#vertices?.heat ?? null) && (heat === null || flows === this.#vertices?.flows)) {
      return;
    }
    this.#vertices = heat === null || flows === null ? null : { flows, heat, shown: heatByVertex(flows, heat) };
    if (this.#moment === null) {
      this.#layHeat(viewer);
    }
  }

  #layHeat(viewer: Viewer): void {
    if (this.#vertices === null) {
      viewer.clearFactors();
      return;
    }
    for (const side of SIDES) {
      const places = this.#vertices.shown.places[side];
      viewer.setFactors(side, places, places);
    }
    viewer.blendFactors(0);
  }

  /** Removes the patches, since the base domain is no longer looked at. */
  leavePatches(viewer: Viewer): void {
    this.wantsPatches = false;
    this.#patches = false;
    this.#lit = null;
    viewer.clearPatches();
  }
}
