/** The messages between the page and the worker of a run. */

import type { Finding, RepairOffer, RunOptions, Stage } from '../report.ts';

/** What came with the source's and the target's file to be laid on the mesh: a picture, or materials with their pictures. */
export type Companions = readonly [Uint8Array | undefined, Uint8Array | undefined];

/** Everything one run needs. */
export interface RunRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The pictures of both meshes. */
  readonly pictures: Companions;
  readonly landmarks: string;
  readonly options: RunOptions;
  /** The demo whose meshes these are, by its id; `null` for other meshes. */
  readonly demo: string | null;
  /** The address of an empty file; when the page revokes it the run is asked to finish. */
  readonly finishUrl: string;
}

/** The request to the worker that makes a small map before the first run. */
export interface WarmUpRequest {
  readonly module: WebAssembly.Module;
  /** The demo whose map is made: its id. */
  readonly demo: string;
}

/** One view's share of the result. */
export interface SideOutput {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly linePoints: Float32Array;
  readonly lineStarts: Uint32Array;
}

/** The base domain of a map. */
export interface BaseOutput {
  /** Its triangles, three cones each. The first cones are the landmarks, the others the program's own. */
  readonly triangles: Uint32Array;
  /** For each corner k of each triangle, the number of the patch line from corner k to k + 1. */
  readonly sides: Uint32Array;
  /** The shape of the base domain on the source and on the target. */
  readonly shapes: readonly [BaseShape, BaseShape];
}

/** The base domain on one mesh. */
export interface BaseShape {
  /** Where the cones are, three numbers each. */
  readonly cones: Float32Array;
  /** Angle defect at each cone, in radians. */
  readonly curvatures: Float64Array;
  /** The corners of the parts into which the mesh is cut, three numbers a point. */
  readonly patchPoints: Float32Array;
  /** The parts as triangles, patch after patch in the order of the base triangles; empty where they are not known. */
  readonly patchTriangles: Uint32Array;
  /** The number of the first triangle of each patch, and the number of all triangles at the end. */
  readonly patchStarts: Uint32Array;
  /** The face of the checked mesh that holds each part triangle. */
  readonly patchFaces: Uint32Array;
  /**
   * The borders of the patches, four numbers a piece: the base triangle's corner at which its side begins (three times the triangle plus
   * the corner), the face of the checked mesh, and the points at its ends.
   */
  readonly patchBorders: Uint32Array;
  /** The face of the checked mesh in the middle of each base triangle's patch. */
  readonly patchMiddles: Uint32Array;
}

/** A finished map. */
export interface RunOutput {
  readonly sides: readonly [SideOutput, SideOutput];
  readonly uvs: Float32Array;
  /** The distortion at each point of the overlay, 1 for none; empty where the method has none. */
  readonly distortion: Float32Array;
  /** The distance of each point to its true image, in units of the root of the target's area; empty where the true map is not known. */
  readonly truth: Float32Array;
  readonly triangles: Uint32Array;
  /** The face of each mesh in which each triangle lies; empty where that is not known. */
  readonly faces: readonly [Uint32Array, Uint32Array];
  readonly cones: Float64Array;
  /** The base domain; `null` where it is not known how it lies on the meshes. */
  readonly base: BaseOutput | null;
  /** The report, as JSON. */
  readonly report: string;
  /** The map file, from which every other file can be made; `null` where the map has no pieces, or a mesh was repaired. */
  readonly map: Uint8Array<ArrayBuffer> | null;
  /** Files that were made with the map, where it has no map file from which to make them later; else `null`. */
  readonly made: MadeFiles | null;
}

/** Files of a map. */
export interface MadeFiles {
  readonly glb: Uint8Array<ArrayBuffer>;
  readonly csv: Uint8Array<ArrayBuffer>;
  readonly baseObj: Uint8Array<ArrayBuffer>;
}

/** The progress of a run; numbers that a step does not have are `null`. */
export interface Progress {
  readonly stage: Stage;
  /** A sentence about what the program does. */
  readonly sentence: string;
  /** Share of the whole run that is done, 0 to 1; it never falls. */
  readonly share: number;
  readonly residual: number | null;
  /** The energy of the map that is being relaxed; 4 is the least, which every conformal map has. */
  readonly energy: number | null;
}

/** A failure: a stable code and the core's own words. */
export interface Failure {
  readonly code: string;
  readonly message: string;
  /** The repair that would help a refused mesh, where there is one. */
  readonly offer?: RepairOffer;
  /** The stack of calls where the program broke off, as the browser gives it. */
  readonly stack?: string;
}

/** The messages of the worker. */
export type WorkerMessage =
  | ({ readonly kind: 'progress' } & Progress)
  | { readonly kind: 'relaxes' }
  | { readonly kind: 'finishable' }
  /** A preview of the map that is being made: for each vertex of the source its place on the target. */
  | { readonly kind: 'preview'; readonly places: Float32Array<ArrayBuffer> }
  | { readonly kind: 'found'; readonly findings: readonly Finding[] }
  | { readonly kind: 'done'; readonly output: RunOutput }
  | { readonly kind: 'failed'; readonly failure: Failure };

/** The core's offer of a repair, in the form in which the core declares it. */
function offerIn(value: object): Pick<Failure, 'offer'> {
  return 'offer' in value && value.offer !== null ? { offer: value.offer as RepairOffer } : {};
}

function stackOf({ stack }: Error): Pick<Failure, 'stack'> {
  return stack === undefined ? {} : { stack };
}

/** The core's last words when it gave up, which the browser's error does not hold; `null` where it said nothing, as when memory ran out. */
function lastPanic(): string | null {
  const said: unknown = Reflect.get(globalThis, 'conemapPanic');
  return typeof said === 'string' ? said : null;
}

/** A further field of an error of the core, beside code and message; `undefined` where the error has no such field. */
export function failureField(thrown: unknown, name: string): unknown {
  try {
    const value: unknown = typeof thrown === 'string' ? JSON.parse(thrown) : null;
    return typeof value === 'object' && value !== null ? Reflect.get(value, name) : undefined;
  } catch {
    return undefined;
  }
}

/** Reads an error of the core: a string that holds `{code, message}`, or a trap. */
export function failureOf(thrown: unknown): Failure {
  if (typeof thrown === 'string') {
    try {
      const value: unknown = JSON.parse(thrown);
      if (typeof value === 'object' && value !== null && 'code' in value && 'message' in value) {
        return { code: String(value.code), message: String(value.message), ...offerIn(value) };
      }
    } catch {
      // Not JSON: the string is the message.
    }
    return { code: 'unknown', message: thrown };
  }
  if (thrown instanceof WebAssembly.RuntimeError) {
    return { code: 'trap', message: lastPanic() ?? thrown.message, ...stackOf(thrown) };
  }
  if (thrown instanceof Error) {
    return { code: 'unknown', message: thrown.message, ...stackOf(thrown) };
  }
  return { code: 'unknown', message: String(thrown) };
}
