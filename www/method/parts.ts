/** Parts of the base domain, and what they are on the meshes. */
import type { BaseOutput } from '../compute/messages.ts';

/** A vertex, a side or a triangle of the base domain, by its number. */
export interface BasePart {
  readonly kind: 'cone' | 'side' | 'face';
  readonly index: number;
}

/** What lights up on the meshes. */
export interface LitParts {
  /** A patch, by the number of its base triangle. */
  readonly patch: number | null;
  /** Patch lines. */
  readonly lines: readonly number[];
}

function at(array: Uint32Array, index: number): number {
  return array[index] ?? 0;
}

/** How many triangles there are. */
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

/** What lights up with a part: of a triangle its patch with its border, of a side its path, of a cone the paths that meet there. */
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

/** What is lit up and held, and how a picture changes it. */
export interface PartHands {
  /** What is lit up: under the mouse on a mesh or on a picture, else what is held. */
  readonly lit: BasePart | null;
  readonly held: BasePart | null;
  /** What is under the mouse on a picture; `null` for nothing. */
  readonly hover: (part: BasePart | null) => void;
  readonly hold: (part: BasePart | null) => void;
}

/** The keys that go from part to part, with Shift backwards. */
export const PART_KEYS: Readonly<Partial<Record<string, BasePart['kind']>>> = { v: 'cone', e: 'side', f: 'face' };

/** The next or the last part of a kind. */
export function stepped(part: BasePart | null, kind: BasePart['kind'], by: 1 | -1, count: number): BasePart {
  const index = part?.kind === kind ? part.index + by : by > 0 ? 0 : count - 1;
  return { kind, index: (index + count) % count };
}
