/** What the page and the worker of a saved map say to each other. */

import type { ProofReport } from '../report.ts';
import type { Companions, Failure, RunOutput } from './messages.ts';

/** A map file with the meshes that it was made with. */
export interface SavedFiles {
  readonly map: Uint8Array;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** What came with both meshes to be laid on them. */
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
  /** What was chosen of the run: JSON; `null` where this version does not know it. */
  readonly options: string | null;
  /** Whether it goes to the mirror image of the target. */
  readonly isMirrored: boolean;
}

/** Points of a map as the views have them. */
export interface WayPoints {
  /** Places on the source, three numbers each. */
  readonly source: Float32Array;
  readonly target: Float32Array;
  /** Three points each. */
  readonly triangles: Uint32Array;
  /** The source's face of each triangle. */
  readonly faces: Uint32Array;
}

/** How the points go from the source's shape to the target's, as the core packs it. */
export interface Way {
  /** The matrix that lays the target on the source, in the views' coordinates. */
  readonly laid: Float32Array;
  /** The length for which 32767 stands in the bends. */
  readonly range: number;
  /** 12 numbers a point. */
  readonly bends: Int16Array;
}

/** To the worker. It opens one map, then answers. */
export type SavedRequest =
  | ({ readonly kind: 'open'; readonly id: number; readonly module: WebAssembly.Module; readonly show: 'views' | 'files' } & SavedFiles)
  | { readonly kind: 'file'; readonly id: number; readonly name: string }
  | { readonly kind: 'wrap'; readonly id: number }
  | { readonly kind: 'way'; readonly id: number; readonly points: WayPoints }
  | { readonly kind: 'prove'; readonly id: number };

/** The source's file laid onto the target. */
export interface WrappedFile {
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** What became of it, in sentences. */
  readonly sentence: string;
}

/** A failure, with the mesh that is not the map's where it is one. */
export interface SavedFailure extends Failure {
  readonly side: 'source' | 'target' | null;
}

/** From the worker: the answer to the request of the same number. */
export type SavedAnswer =
  | { readonly kind: 'opened'; readonly id: number; readonly opened: OpenedMap | null }
  | { readonly kind: 'file'; readonly id: number; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: 'wrapped'; readonly id: number; readonly wrapped: WrappedFile }
  | { readonly kind: 'way'; readonly id: number; readonly way: Way }
  | { readonly kind: 'proved'; readonly id: number; readonly proof: ProofReport }
  | { readonly kind: 'failed'; readonly id: number; readonly failure: SavedFailure };
