/** The parts of the base domain, and what stands for them on the meshes. */
import type { BaseOutput } from '../compute/messages.ts';

/** A cone (vertex), a side or a triangle of the base domain, by its number. */
export interface BasePart {
  readonly kind: 'cone' | 'side' | 'face';
  readonly index: number;
}

/** What is lit up on the meshes. */
export interface LitParts {
  /** The patch that is lit up, by the number of its base triangle; `null` for none. */
  readonly patch: number | null;
  /** The patch lines that are lit up. */
  readonly lines: readonly number[];
}

function at(array: Uint32Array, index: number): number {
  return array[index] ?? 0;
}

/** The number of triangles in a base domain. */
export function faceCount({ triangles }: BaseOutput): number {
  return triangles.length / 3;
}

/** The cones of a triangle, counter-clockwise. */
export function conesOfFace({ triangles }: BaseOutput, face: number): readonly [number, number, number] {
  return [at(triangles, 3 * face), at(triangles, 3 * face + 1), at(triangles, 3 * face + 2)];
}

/** The sides of a triangle: side k goes from corner k to k + 1. */
export function sidesOfFace({ sides }: BaseOutput, face: number): readonly [number, number, number] {
  return [at(sides, 3 * face), at(sides, 3 * face + 1), at(sides, 3 * face + 2)];
}

/** The two cones that each side joins, by the side's number. */
export function endsOfSides(base: BaseOutput): readonly (readonly [number, number])[] {
  const ends: (readonly [number, number])[] = [];
  base.sides.forEach((side, corner) => {
    const next = corner % 3 === 2 ? corner - 2 : corner + 1;
    ends[side] ??= [at(base.triangles, corner), at(base.triangles, next)];
  });
  return ends;
}

/**
 * What is lit up on the meshes for a part: for a triangle its patch and the patch's border, for a side its path, for a cone the paths that
 * meet there.
 */
export function litBy(base: BaseOutput, part: BasePart | null): LitParts {
  if (part === null) {
    return { patch: null, lines: [] };
  }
  switch (part.kind) {
    case 'face':
      return { patch: part.index, lines: sidesOfFace(base, part.index) };
    case 'side':
      return { patch: null, lines: [part.index] };
    case 'cone':
      return { patch: null, lines: endsOfSides(base).flatMap((ends, side) => (ends.includes(part.index) ? [side] : [])) };
  }
}

/** The parts that are lit up and held, and the functions by which a picture changes them. */
export interface PartHands {
  /** The part that is lit up: the one under the mouse on a mesh or a picture, or else the held one. */
  readonly lit: BasePart | null;
  readonly held: BasePart | null;
  /** Reports the part under the mouse on a picture; `null` for none. */
  readonly hover: (part: BasePart | null) => void;
  readonly hold: (part: BasePart | null) => void;
}

/** The keys that step from part to part, with Shift backwards. */
export const PART_KEYS: Readonly<Partial<Record<string, BasePart['kind']>>> = { v: 'cone', e: 'side', f: 'face' };

/** The part of a kind after a given one, or before it. */
export function stepped(part: BasePart | null, kind: BasePart['kind'], by: 1 | -1, count: number): BasePart {
  const index = part?.kind === kind ? part.index + by : by > 0 ? 0 : count - 1;
  return { kind, index: (index + count) % count };
}
