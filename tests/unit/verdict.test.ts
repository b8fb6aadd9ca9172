/** Sentences about how good a map is. */
import { describe, expect, test } from 'vitest';
import { largestStretch, verdictOf } from '../../www/panels/verdict.ts';
import type { Report } from '../../www/report.ts';

/** (s1² + s2² + s1⁻² + s2⁻²) / 4. */
function density(s1: number, s2: number): number {
  return (s1 ** 2 + s2 ** 2 + s1 ** -2 + s2 ** -2) / 4;
}

function report(p95: number, change: object = {}): Report {
  return {
    certificate: { bijective: true },
    distortion: { p95, median: 1.01 },
    coverage: null,
    unmapped_share: 0,
    ...change,
  } as unknown as Report;
}

describe('the largest stretch of a density', () => {
  test('is the stretch where only one direction is stretched', () => {
    for (const stretch of [1, 1.2, 2, 7]) {
      expect(largestStretch(density(stretch, 1))).toBeCloseTo(stretch, 9);
      expect(largestStretch(density(1, 1 / stretch))).toBeCloseTo(stretch, 9);
    }
  });

  test('is no less than either direction is stretched or squeezed', () => {
    for (const s1 of [0.2, 0.7, 1, 1.5, 4]) {
      for (const s2 of [0.3, 1, 2.5]) {
        const most = Math.max(s1, 1 / s1, s2, 1 / s2);
        expect(largestStretch(density(s1, s2))).toBeGreaterThanOrEqual(most - 1e-12);
      }
    }
  });

  test('is 1 where rounding brought the density below 1', () => {
    expect(largestStretch(1 - 1e-12)).toBe(1);
  });
});

describe('the verdict', () => {
  test('is the worse the more is stretched, and its number is never too small', () => {
    const words = [1.1, 1.4, 2, 9].map((p95) => verdictOf(report(p95)));
    expect(words.map(({ level }) => level)).toEqual(['good', 'good', 'fair', 'rough']);
    expect(words.map(({ sentence }) => sentence.split(' map:')[0])).toEqual(['Very good', 'Good', 'Fair', 'Rough']);
    for (const [index, p95] of [1.1, 1.4, 2, 9].entries()) {
      const told = Number(/less than ([\d.]+)/.exec(words[index]?.sentence ?? '')?.[1]);
      expect(told).toBeGreaterThanOrEqual(largestStretch(p95));
      expect(told).toBeLessThan(largestStretch(p95) + 0.011);
    }
  });

  test('without a certificate praises nothing', () => {
    const open = verdictOf(report(1.001, { certificate: null, unmapped_share: 0.0123 }));
    expect(open.level).toBe('open');
    expect(open.more).toContain('1.2 %');
    expect(verdictOf(report(1.001, { certificate: { bijective: false } })).level).toBe('open');
  });
});
