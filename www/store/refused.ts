/** Meshes that were refused: they are shown with what is wrong, and wait for a repair that would help, or to be left out. */
import type { Side } from '../landmarks.ts';
import type { RepairOffer } from '../report.ts';
import type { RepairOptions } from '../wasm/core.js';
import type { LandmarkContent } from '../wasm/page.js';
import type { Examined } from './defects.ts';

/** What a repair may do beyond what does not change the shape, as the core reads it; what is left out it may not. */
export type Allowed = Readonly<Pick<RepairOptions, 'parts' | 'handles'>>;

/**
 * All of it. A mesh that came onto a page with less comes out alike, so that what was accepted once is read again by this: from
 * the browser's store, of a project, in the worker.
 */
export const ALL_ALLOWED: Allowed = { parts: 'largest-alone', handles: 'cut' };

/** A file as it was given. */
export interface GivenFile {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly address?: string;
}

/** A landmark file as it was given. */
export interface GivenMarks extends GivenFile {
  /** Landmarks of one mesh, of both, or pairs in the meshes' own numbers. */
  readonly content: LandmarkContent;
}

/** A mesh that was refused. */
export interface RefusedMesh {
  /** Where it was to come. */
  readonly side: Side;
  readonly file: GivenFile;
  /** What its repair may do already. */
  readonly allowed: Allowed;
  /** What would help beyond; `null` where nothing would. */
  readonly offer: RepairOffer | null;
  /** Why it was refused. */
  readonly sentence: string;
  /** What is wrong with it, for the view and the list. */
  readonly examined: Examined;
}

/** What waits for the user's word. */
export interface Refused {
  /** At least one, each for another side. */
  readonly meshes: readonly RefusedMesh[];
  /** Landmark files that were given with them. */
  readonly landmarks: readonly GivenMarks[];
}

/** The options that an offer allows beside those that there are. */
export function allowedBy({ allowed, offer }: Pick<RefusedMesh, 'allowed' | 'offer'>): Allowed {
  if (offer === null) {
    return allowed;
  }
  return offer.kind === 'cut-handles' ? { ...allowed, handles: 'cut' } : { ...allowed, parts: 'largest-alone' };
}

/** Without the mesh of a side: something else came there, or nothing is to come. */
export function withoutSide(refused: Refused | null, side: Side): Refused | null {
  const meshes = refused?.meshes.filter((mesh) => mesh.side !== side) ?? [];
  if (refused === null || meshes.length === refused.meshes.length) {
    return refused;
  }
  return meshes.length === 0 ? null : { ...refused, meshes };
}
