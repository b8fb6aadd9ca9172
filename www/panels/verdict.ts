/** Sentences about how good a finished map is, for readers who do not know the method. */
import type { Report } from '../report.ts';

export interface Verdict {
  /** How good the map is; `open` where nothing proves that it is one-to-one. */
  readonly level: 'good' | 'fair' | 'rough' | 'open';
  readonly sentence: string;
  /** Details that the sentence leaves out; empty where there are none. */
  readonly more: string;
}

/** The factors up to which 95 % of the surface may be stretched in a very good, a good and a fair map. They were chosen by hand. */
const VERY_GOOD = 1.5;
const GOOD = 2;
const FAIR = 3.5;

/**
 * The largest factor by which a place of this density (s1² + s2² + s1⁻² + s2⁻²) / 4 can be stretched or squeezed: the
 * other direction takes at least 2 of the sum, so that s² + s⁻² <= 4 density - 2.
 */
export function largestStretch(density: number): number {
  const half = Math.max(1, 2 * density - 1);
  return Math.sqrt(half + Math.sqrt(half * half - 1));
}

/** A factor with two decimals, such as 1.52, rounded up so that "less than" stays true. */
function factor(value: number): string {
  return (Math.ceil(value * 100) / 100).toFixed(2);
}

/** Says how good a map is. */
export function verdictOf(report: Report): Verdict {
  const { certificate, distortion, unmapped_share: unmapped } = report;
  if (certificate?.bijective !== true) {
    const more =
      unmapped > 0
        ? `This method left ${(100 * unmapped).toFixed(unmapped < 0.01 ? 2 : 1)} % of the source without an image.`
        : 'Every vertex of the source has an image, but the map need not be one-to-one.';
    return { level: 'open', sentence: 'A map without a proof.', more };
  }
  const most = largestStretch(distortion.p95);
  const [level, word] =
    most < VERY_GOOD
      ? (['good', 'Very good'] as const)
      : most < GOOD
        ? (['good', 'Good'] as const)
        : most < FAIR
          ? (['fair', 'Fair'] as const)
          : (['rough', 'Rough'] as const);
  return {
    level,
    sentence: `${word} map: 95 % of the surface is stretched or squeezed by less than ${factor(most)} times.`,
    more: `Half of it by less than ${factor(largestStretch(distortion.median))} times, both meshes taken at the same size.`,
  };
}
