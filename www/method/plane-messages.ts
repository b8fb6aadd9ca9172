/** What the page and the worker that lays the flat metrics out in the plane say to each other. */
import type { BaseOutput, Failure } from '../compute/messages.ts';
import type { Side } from '../landmarks.ts';
import type { BasePart } from './parts.ts';

/** What the worker begins with. */
export interface PlaneRequest {
  readonly module: WebAssembly.Module;
  readonly source: Uint8Array;
  readonly target: Uint8Array;
  /** The landmark file of the map. */
  readonly landmarks: string;
  /** Curvature of each landmark's cone, in radians. */
  readonly cones: Float64Array;
  /** `null` where it is not known how it lies on the meshes. */
  readonly base: BaseOutput | null;
}

/** One mesh in the plane, as the page knows it. */
export interface GrownSide {
  /** Where each ring around the seed starts among the triangles, and one past the end. */
  readonly rings: Uint32Array;
  /** The least x and y and the largest, in units of the plane: the mesh has area 1. */
  readonly box: readonly [number, number, number, number];
  /** Triangles that lie turned over. */
  readonly turnedOver: number;
  /** Edges along which the layout is cut. */
  readonly cutEdges: number;
}

/** How a mesh in the plane is drawn. */
export interface PlaneFrame {
  readonly side: Side;
  /** Size of the picture in its own pixels. */
  readonly width: number;
  readonly height: number;
  /** So many of them are one of the page's. */
  readonly density: number;
  /** The place of the plane in the middle of the picture, and pixels per unit of the plane. */
  readonly x: number;
  readonly y: number;
  readonly scale: number;
  /** So many triangles are placed. */
  readonly shown: number;
  readonly lit: BasePart | null;
  readonly circles: 'shown' | 'hidden';
  readonly look: 'light' | 'dark';
}

/** A place of the plane that is asked about. */
export interface PlaneSpot {
  readonly side: Side;
  readonly x: number;
  readonly y: number;
  /** What is nearer is meant. */
  readonly reach: number;
  readonly shown: number;
}

export interface PlaneFileWish {
  readonly side: Side;
  readonly format: 'svg' | 'png' | 'obj';
  /** What the landmarks are called. */
  readonly names: readonly string[];
  readonly circles: 'shown' | 'hidden';
  readonly shown: number;
}

/** What can be asked. */
export interface PlaneQuestions {
  /** To lay both meshes out from a patch, by its base triangle. */
  readonly grow: number;
  readonly draw: PlaneFrame;
  readonly ask: PlaneSpot;
  readonly save: PlaneFileWish;
}

/** What each question is answered with. */
export interface PlaneAnswers {
  readonly grow: readonly [GrownSide, GrownSide];
  readonly draw: ImageBitmap;
  readonly ask: BasePart | null;
  readonly save: Blob;
}

export type PlaneQuestion = {
  [K in keyof PlaneQuestions]: { readonly kind: K; readonly number: number; readonly question: PlaneQuestions[K] };
}[keyof PlaneQuestions];

/** From the worker. */
export type PlaneMessage =
  /** The share of the flows that is done, 0 to 1. */
  | { readonly kind: 'progress'; readonly share: number }
  /** It can be asked. */
  | { readonly kind: 'ready' }
  | { readonly kind: 'answer'; readonly number: number; readonly answer: PlaneAnswers[keyof PlaneAnswers] }
  | { readonly kind: 'failed'; readonly failure: Failure };
