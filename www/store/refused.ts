/** Refused meshes: they are shown with what is wrong with them, until the user has them repaired or leaves them out. */
import type { Side } from '../landmarks.ts';
import type { RepairOffer } from '../report.ts';
import type { RepairOptions } from '../wasm/core.js';
import type { LandmarkContent } from '../wasm/page.js';
import type { Examined } from './defects.ts';

/**
 * The repairs that are allowed beyond those that do not change the shape, as the core reads them; a repair that is left out is not allowed.
 */
export type Allowed = Readonly<Pick<RepairOptions, 'parts' | 'handles'>>;

/**
 * All repairs. A mesh that came onto a page with fewer allowed comes out the same, so all meshes that were accepted once are read again
 * with these: from the browser's store, from a project, and in the worker.
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
  /** Whether the file has landmarks of one mesh, of both, or pairs by the meshes' own numbers. */
  readonly content: LandmarkContent;
}

/** A mesh that was refused. */
export interface RefusedMesh {
  /** The side for which it was given. */
  readonly side: Side;
  readonly file: GivenFile;
  /** The repairs that are allowed already. */
  readonly allowed: Allowed;
  /** The further repair that would help; `null` where none would. */
  readonly offer: RepairOffer | null;
  /** The sentence that says why it was refused. */
  readonly sentence: string;
  /** The defects, for the view and the list. */
  readonly examined: Examined;
}

/** Refused meshes that wait for the user's decision. */
export interface Refused {
  /** At least one mesh, and at most one for each side. */
  readonly meshes: readonly RefusedMesh[];
  /** The landmark files that were given with them. */
  readonly landmarks: readonly GivenMarks[];
}

/** The repairs that are allowed once an offer is accepted. */
export function allowedBy({ allowed, offer }: Pick<RefusedMesh, 'allowed' | 'offer'>): Allowed {
  if (offer === null) {
    return allowed;
  }
  return offer.kind === 'cut-handles' ? { ...allowed, handles: 'cut' } : { ...allowed, parts: 'largest-alone' };
}

/** The refused meshes without the one of a side, because another mesh came there or none is wanted. */
export function withoutSide(refused: Refused | null, side: Side): Refused | null {
  const meshes = refused?.meshes.filter((mesh) => mesh.side !== side) ?? [];
  if (refused === null || meshes.length === refused.meshes.length) {
    return refused;
  }
  return meshes.length === 0 ? null : { ...refused, meshes };
}
