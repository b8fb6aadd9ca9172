/** What the page and the worker of a saved map say to each other. */

import type { Failure, RunOutput } from './messages.ts';

/** A map file with the meshes that it was made with. */
export interface SavedFiles {
  readonly map: Uint8Array;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
}

/** What the views show of a map, as a run gives it. */
export type MapBuffers = Pick<RunOutput, 'sides' | 'uvs' | 'distortion' | 'triangles' | 'cones' | 'report'>;

/** A saved map that is open. */
export interface OpenedMap {
  readonly buffers: MapBuffers;
  /** The landmark file of the run. */
  readonly landmarks: Uint8Array<ArrayBuffer>;
  /** What was chosen of the run: JSON. */
  readonly options: string;
  /** The measures, made anew from the pieces: JSON. */
  readonly distortion: string;
}

/** A point of a mesh's file. */
export interface FilePoint {
  readonly face: number;
  readonly weights: readonly [number, number, number];
}

/** The image of a point. */
export interface ImagePoint extends FilePoint {
  readonly position: readonly [number, number, number];
}

/** To the worker. It opens one map, then answers. */
export type SavedRequest =
  | ({ readonly kind: 'open'; readonly id: number; readonly module: WebAssembly.Module; readonly show: 'views' | 'files' } & SavedFiles)
  | { readonly kind: 'file'; readonly id: number; readonly name: string }
  | { readonly kind: 'image'; readonly id: number; readonly side: 0 | 1; readonly point: FilePoint };

/** A failure, with the mesh that is not the map's where it is one. */
export interface SavedFailure extends Failure {
  readonly side: 'source' | 'target' | null;
}

/** From the worker: the answer to the request of the same number. */
export type SavedAnswer =
  | { readonly kind: 'opened'; readonly id: number; readonly opened: OpenedMap | null }
  | { readonly kind: 'file'; readonly id: number; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly kind: 'image'; readonly id: number; readonly image: ImagePoint | null }
  | { readonly kind: 'failed'; readonly id: number; readonly failure: SavedFailure };
