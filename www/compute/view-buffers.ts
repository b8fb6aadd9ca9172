/** A map of the core as arrays that can be sent. */
import type { MapOutput, SavedMap } from '../wasm/conemap.js';
import type { SideOutput } from './messages.ts';
import type { MapBuffers, OpenedMap } from './saved-messages.ts';

function sideOf(output: MapOutput, side: number): SideOutput {
  return {
    positions: output.positions(side),
    normals: output.normals(side),
    linePoints: output.linePoints(side),
    lineStarts: output.lineStarts(side),
  };
}

/** What the views show of a map. */
export function viewBuffers(output: MapOutput): MapBuffers {
  return {
    sides: [sideOf(output, 0), sideOf(output, 1)],
    uvs: output.uvs(),
    distortion: output.distortion(),
    triangles: output.triangles(),
    cones: output.cones(),
    report: output.report(),
  };
}

/** What the page takes of a saved map; the core's own copy of it is free again. */
export function openedOf(map: SavedMap): OpenedMap {
  const output = map.output();
  const buffers = viewBuffers(output);
  output.free();
  return { buffers, landmarks: map.landmarks().slice(), options: map.options() ?? null, isMirrored: map.isMirrored() };
}

/** The buffers of them, to be handed over. */
export function transferable(buffers: MapBuffers, files: readonly Uint8Array[]): Transferable[] {
  const arrays = [
    ...buffers.sides.flatMap((side) => [side.positions, side.normals, side.linePoints, side.lineStarts]),
    buffers.uvs,
    buffers.distortion,
    buffers.triangles,
    buffers.cones,
    ...files,
  ];
  return [...new Set(arrays.map((array) => array.buffer))].filter((buffer) => buffer instanceof ArrayBuffer);
}
