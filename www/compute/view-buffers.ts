/** Converts a map of the core into arrays that can be sent between threads. */
import type { MapOutput, SavedMap } from '../wasm/core.js';
import type { BaseOutput, BaseShape, SideOutput } from './messages.ts';
import type { MapBuffers, OpenedMap } from './saved-messages.ts';

function sideOf(output: MapOutput, side: number): SideOutput {
  return {
    positions: output.positions(side),
    normals: output.normals(side),
    linePoints: output.linePoints(side),
    lineStarts: output.lineStarts(side),
  };
}

function shapeOf(output: MapOutput, side: number): BaseShape {
  return {
    cones: output.baseCones(side),
    curvatures: output.baseCurvatures(side),
    patchPoints: output.patchPoints(side),
    patchTriangles: output.patchTriangles(side),
    patchStarts: output.patchStarts(side),
    patchFaces: output.patchFaces(side),
    patchBorders: output.patchBorders(side),
    patchMiddles: output.patchMiddles(side),
  };
}

function baseOf(output: MapOutput): BaseOutput | null {
  const triangles = output.baseTriangles();
  return triangles.length === 0 ? null : { triangles, sides: output.baseSides(), shapes: [shapeOf(output, 0), shapeOf(output, 1)] };
}

function arraysOf(base: BaseOutput): readonly ArrayBufferView[] {
  return [base.triangles, base.sides, ...base.shapes.flatMap((shape) => Object.values(shape) as readonly ArrayBufferView[])];
}

/** The arrays that the views show of a map. */
export function viewBuffers(output: MapOutput): MapBuffers {
  return {
    sides: [sideOf(output, 0), sideOf(output, 1)],
    uvs: output.uvs(),
    distortion: output.distortion(),
    truth: output.truth(),
    triangles: output.triangles(),
    faces: [output.faces(0), output.faces(1)],
    cones: output.cones(),
    base: baseOf(output),
    report: output.report(),
  };
}

/** What the page takes of a saved map; `demo` is the id of the demo whose map it is. The core's own copy of the map's arrays is freed. */
export function openedOf(map: SavedMap, demo: string | null): OpenedMap {
  const output = map.output(demo);
  const buffers = viewBuffers(output);
  output.free();
  return { buffers, landmarks: map.landmarks().slice(), options: map.options() ?? null, isMirrored: map.isMirrored() };
}

/** The buffers of these arrays and files, to be transferred without a copy. */
export function transferable(buffers: MapBuffers, files: readonly Uint8Array[]): Transferable[] {
  const arrays = [
    ...buffers.sides.flatMap((side) => [side.positions, side.normals, side.linePoints, side.lineStarts]),
    buffers.uvs,
    buffers.distortion,
    buffers.truth,
    buffers.triangles,
    ...buffers.faces,
    buffers.cones,
    ...(buffers.base === null ? [] : arraysOf(buffers.base)),
    ...files,
  ];
  return [...new Set(arrays.map((array) => array.buffer))].filter((buffer) => buffer instanceof ArrayBuffer);
}
