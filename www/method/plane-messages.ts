/** The messages between the page and the worker that lays the flat metrics out in the plane. */
import type { BaseOutput, Failure } from '../compute/messages.ts';
import type { Side } from '../landmarks.ts';
import type { BasePart } from './parts.ts';

/** The worker's first request. */
export interface PlaneRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmark file of the map. */
  readonly landmarks: string;
  /** The curvature of each landmark's cone, in radians. */
  readonly cones: Float64Array;
  /** The base domain; `null` where it is not known how it lies on the meshes. */
  readonly base: BaseOutput | null;
}

/** The layout of one mesh in the plane, as far as the page needs it. */
export interface GrownSide {
  /** The number of the first triangle of each ring around the seed, and the number of all triangles at the end. */
  readonly rings: Uint32Array;
  /** The least x and y, then the largest, in units of the plane, in which the mesh has area 1. */
  readonly box: readonly [number, number, number, number];
  /** The number of triangles that lie turned over. */
  readonly turnedOver: number;
  /** The number of edges along which the layout is cut. */
  readonly cutEdges: number;
}

/** A frame of a mesh in the plane. */
export interface PlaneFrame {
  readonly side: Side;
  /** The size of the picture in its own pixels. */
  readonly width: number;
  readonly height: number;
  /** How many of these pixels make one pixel of the page. */
  readonly density: number;
  /** The point of the plane at the middle of the picture, and the number of pixels per unit of the plane. */
  readonly x: number;
  readonly y: number;
  readonly scale: number;
  /** The number of triangles that are drawn. */
  readonly shown: number;
  readonly lit: BasePart | null;
  readonly circles: 'shown' | 'hidden';
  readonly look: 'light' | 'dark';
}

/** A question about the part at a point of the plane. */
export interface PlaneSpot {
  readonly side: Side;
  readonly x: number;
  readonly y: number;
  /** The distance within which a part is meant, in units of the plane. */
  readonly reach: number;
  readonly shown: number;
}

export interface PlaneFileWish {
  readonly side: Side;
  readonly format: 'svg' | 'png' | 'obj';
  /** The names of the landmarks. */
  readonly names: readonly string[];
  readonly circles: 'shown' | 'hidden';
  readonly shown: number;
}

/** The questions that can be asked, by kind. */
export interface PlaneQuestions {
  /** Lays both meshes out from a patch, given by its base triangle. */
  readonly grow: number;
  readonly draw: PlaneFrame;
  readonly ask: PlaneSpot;
  readonly save: PlaneFileWish;
}

/** The answer to each kind of question. */
export interface PlaneAnswers {
  readonly grow: readonly [GrownSide, GrownSide];
  readonly draw: ImageBitmap;
  readonly ask: BasePart | null;
  readonly save: Blob;
}

export type PlaneQuestion = {
  [K in keyof PlaneQuestions]: { readonly kind: K; readonly number: number; readonly question: PlaneQuestions[K] };
}[keyof PlaneQuestions];

/** The messages of the worker. */
export type PlaneMessage =
  /** The share of the flows that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** The worker can be asked. */
  | { readonly kind: 'ready' }
  | { readonly kind: 'answer'; readonly number: number; readonly answer: PlaneAnswers[keyof PlaneAnswers] }
  | { readonly kind: 'failed'; readonly failure: Failure };
