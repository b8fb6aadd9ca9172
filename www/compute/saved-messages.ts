/** The messages between the page and the worker of a saved map. */

import type { ProofReport } from '../report.ts';
import type { Companions, Failure, RunOutput } from './messages.ts';

/** A map file with the meshes that it was made with. */
export interface SavedFiles {
  readonly map: Uint8Array;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The pictures of both meshes. */
  readonly pictures?: Companions;
  /** The demo whose meshes these are, by its id; without it nothing is known of the true map. */
  readonly demo?: string | null;
}

/** What the views show of a map, as a run gives it. */
export type MapBuffers = Pick<RunOutput, 'sides' | 'uvs' | 'distortion' | 'truth' | 'triangles' | 'faces' | 'cones' | 'base' | 'report'>;

/** A saved map that is open. */
export interface OpenedMap {
  readonly buffers: MapBuffers;
  /** The landmark file of the run. */
  readonly landmarks: Uint8Array<ArrayBuffer>;
  /** The options of the run, as JSON; `null` where this version does not know them. */
  readonly options: string | null;
  /** Whether the map goes to the mirror image of the target. */
  readonly isMirrored: boolean;
}

/** Points of a map, in the views' coordinates. */
export interface WayPoints {
  /** Places on the source, three numbers each. */
  readonly source: Float32Array;
  readonly target: Float32Array;
  /** The triangles between the points, three points each. */
  readonly triangles: Uint32Array;
  /** The source's face of each triangle. */
  readonly faces: Uint32Array;
}

/** How the points move from the source's shape to the target's, as the core packs it. */
export interface Way {
  /** The matrix that lays the target on the source, in the views' coordinates. */
  readonly laid: Float32Array;
  /** The length that the number 32767 stands for in the bends. */
  readonly range: number;
  /** The bends, 12 numbers a point. */
  readonly bends: Int16Array;
}

/** The requests to the worker. The first one opens a map, and the others ask about it. */
export type SavedRequest =
  | ({ readonly kind: 'open'; readonly id: number; readonly module: WebAssembly.Module; readonly show: 'views' | 'files' } & SavedFiles)
  | { readonly kind: 'file'; readonly id: number; readonly name: string }
  | { readonly kind: 'wrap'; readonly id: number }
  | { readonly kind: 'way'; readonly id: number; readonly points: WayPoints }
  | { readonly kind: 'prove'; readonly id: number };

/** The source's file laid onto the target. */
export interface WrappedFile {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** Sentences about the result. */
  readonly sentence: string;
}

/** A failure, with the side whose mesh is not the map's; `null` where the failure has another cause. */
export interface SavedFailure extends Failure {
  readonly side: 'source' | 'target' | null;
}

/** The worker's answer to the request with the same id. */
export type SavedAnswer =
  | { readonly kind: 'opened'; readonly id: number; readonly opened: OpenedMap | null }
  | { readonly kind: 'file'; readonly id: number; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: 'wrapped'; readonly id: number; readonly wrapped: WrappedFile }
  | { readonly kind: 'way'; readonly id: number; readonly way: Way }
  | { readonly kind: 'proved'; readonly id: number; readonly proof: ProofReport }
  | { readonly kind: 'failed'; readonly id: number; readonly failure: SavedFailure };
