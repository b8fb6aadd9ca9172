/** What the page and the worker say to each other. */

import type { Finding, RepairOffer, RunOptions, Stage } from '../report.ts';

/** What came with the source and the target to be laid on them: a picture, or materials with theirs. */
export type Companions = readonly [Uint8Array | undefined, Uint8Array | undefined];

/** Everything one run needs. */
export interface RunRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** What came with both to be laid on them. */
  readonly pictures: Companions;
  readonly landmarks: string;
  readonly options: RunOptions;
  /** The demo whose meshes these are, by its id; `null` for other meshes. */
  readonly demo: string | null;
  /** The address of an empty file; when the page takes it back the run is to finish. */
  readonly finishUrl: string;
}

/** What the worker needs that makes a small map before the first run. */
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
  /** By triangle and corner k the number of the patch line from corner k to k + 1. */
  readonly sides: Uint32Array;
  /** In the shape of the source and of the target. */
  readonly shapes: readonly [BaseShape, BaseShape];
}

/** The base domain on one mesh. */
export interface BaseShape {
  /** Where the cones are, three numbers each. */
  readonly cones: Float32Array;
  /** Angle defect at each cone, in radians. */
  readonly curvatures: Float64Array;
  /** Corners of the mesh's parts, three numbers a point. */
  readonly patchPoints: Float32Array;
  /** Those parts as triangles, patch after patch in the order of the base triangles; none where they are not known. */
  readonly patchTriangles: Uint32Array;
  /** Where each patch starts among the triangles, and one past the end. */
  readonly patchStarts: Uint32Array;
  /** By part triangle the face of the checked mesh that holds it. */
  readonly patchFaces: Uint32Array;
  /**
   * The borders of the patches, four numbers a piece: the base triangle's corner at which its side begins (three times the triangle plus
   * the corner), the face of the checked mesh, and the points at its ends.
   */
  readonly patchBorders: Uint32Array;
  /** By base triangle the face of the checked mesh in the middle of its patch. */
  readonly patchMiddles: Uint32Array;
}

/** A finished map. */
export interface RunOutput {
  readonly sides: readonly [SideOutput, SideOutput];
  readonly uvs: Float32Array;
  /** By point, 1 for none; empty where the method has none. */
  readonly distortion: Float32Array;
  /** By point the distance to its true image, in units of the root of the target's area; empty where that is not known. */
  readonly truth: Float32Array;
  readonly triangles: Uint32Array;
  /** The face of each mesh in which each triangle lies; empty where that is not known. */
  readonly faces: readonly [Uint32Array, Uint32Array];
  readonly cones: Float64Array;
  /** `null` where it is not known how it lies on the meshes. */
  readonly base: BaseOutput | null;
  /** JSON. */
  readonly report: string;
  /** The map file, from which every other file can be made; `null` where the map has no pieces, or a mesh was repaired. */
  readonly map: Uint8Array<ArrayBuffer> | null;
  /** Files that were made with the map, where it has no map file to make them of later; else `null`. */
  readonly made: MadeFiles | null;
}

/** Files of a map. */
export interface MadeFiles {
  readonly glb: Uint8Array<ArrayBuffer>;
  readonly csv: Uint8Array<ArrayBuffer>;
  readonly baseObj: Uint8Array<ArrayBuffer>;
}

/** Where a run is; numbers that a step does not have are `null`. */
export interface Progress {
  readonly stage: Stage;
  /** What the program does, in words. */
  readonly sentence: string;
  /** Share of the whole run that is done, 0 to 1; it never falls. */
  readonly share: number;
  readonly residual: number | null;
  /** Of the map that is being relaxed, 4 for an isometry. */
  readonly energy: number | null;
}

/** A failure: a stable code and the core's own words. */
export interface Failure {
  readonly code: string;
  readonly message: string;
  /** Of a mesh that was refused: the repair that would help, where there is one. */
  readonly offer?: RepairOffer;
  /** Of what broke off: the calls that led there, as the browser tells them. */
  readonly stack?: string;
}

/** From the worker. */
export type WorkerMessage =
  | ({ readonly kind: 'progress' } & Progress)
  | { readonly kind: 'relaxes' }
  | { readonly kind: 'finishable' }
  /** The map as it is being made: by vertex of the source its place on the target. */
  | { readonly kind: 'preview'; readonly places: Float32Array<ArrayBuffer> }
  | { readonly kind: 'found'; readonly findings: readonly Finding[] }
  | { readonly kind: 'done'; readonly output: RunOutput }
  | { readonly kind: 'failed'; readonly failure: Failure };

/** The core's own offer, which is as it declares it. */
function offerIn(value: object): Pick<Failure, 'offer'> {
  return 'offer' in value && value.offer !== null ? { offer: value.offer as RepairOffer } : {};
}

function stackOf({ stack }: Error): Pick<Failure, 'stack'> {
  return stack === undefined ? {} : { stack };
}

/** What the core said when it gave up, which the browser's error does not hold; it says nothing where memory ran out. */
function lastPanic(): string | null {
  const said: unknown = Reflect.get(globalThis, 'conemapPanic');
  return typeof said === 'string' ? said : null;
}

/** What the core throws says of itself under a name, beside code and message; `undefined` where it says nothing. */
export function failureField(thrown: unknown, name: string): unknown {
  try {
    const value: unknown = typeof thrown === 'string' ? JSON.parse(thrown) : null;
    return typeof value === 'object' && value !== null ? Reflect.get(value, name) : undefined;
  } catch {
    return undefined;
  }
}

/** Reads what the core throws: a string that holds `{code, message}`, or a trap. */
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
