/** A map of the core as arrays that can be sent. */
import type { MapOutput } from '../wasm/conemap.js';
import type { SideOutput } from './messages.ts';
import type { MapBuffers } from './saved-messages.ts';

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
