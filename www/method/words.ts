/** Sentences about the parts of the base domain. */
import type { BasePart } from './parts.ts';
import { conesOfFace } from './parts.ts';
import type { Solid } from './picture.ts';

/** An angle in degrees with its sign, as curvatures are written. */
export function degrees(radians: number): string {
  const angle = Math.round((radians * 1800) / Math.PI) / 10;
  return `${angle > 0 ? '+' : angle < 0 ? '−' : ''}${Math.abs(angle).toFixed(1)}°`;
}

/** The name of a cone: that of its landmark, or `own` with a number for a cone that the program has added. */
export function coneName(names: readonly string[], cone: number): string {
  return names[cone] ?? `own ${cone + 1 - names.length}`;
}

/** A sentence about a part, and about what lights up with it. */
export function reading({ base, curvatures, ends }: Solid, part: BasePart, names: readonly string[]): string {
  const name = (cone: number): string => coneName(names, cone);
  switch (part.kind) {
    case 'cone': {
      const curvature = curvatures[part.index] ?? 0;
      const kind = curvature < 0 ? 'saddle-like' : 'bulging';
      return `Corner ${name(part.index)}: curvature ${degrees(curvature)}, ${kind}. Its paths are lit up.`;
    }
    case 'side': {
      const [from, to] = ends[part.index] ?? [0, 0];
      return `Side from ${name(from)} to ${name(to)}: its path is lit up on both meshes.`;
    }
    case 'face':
      return `Triangle of ${conesOfFace(base, part.index).map(name).join(', ')}: its patch is lit up on both meshes.`;
  }
}

/** A sentence about the whole base domain. */
export function summary({ curvatures, ends, base }: Solid): string {
  const positive = curvatures.filter((curvature) => curvature >= 0).length;
  const sum = curvatures.reduce((total, curvature) => total + curvature, 0);
  return `${curvatures.length} corners, ${ends.length} sides, ${base.triangles.length / 3} triangles. ${positive} corners bulge, ${curvatures.length - positive} are saddle-like; their curvatures sum to ${degrees(sum)}, as on every closed surface without handles.`;
}
