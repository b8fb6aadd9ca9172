/** The scales of heat maps: from values to places on a scale of colours, 0 to 1, and back. */
import { placeOf } from '../method/factors.ts';
import type { HeatMap } from '../store/state.ts';

export interface Scale {
  /** From little to much, or from what shrinks to what grows. */
  readonly colours: 'rising' | 'diverging';
  /** Where a value lies; beyond the ends below 0 or above 1. */
  readonly place: (value: number) => number;
  /** The value there. */
  readonly value: (place: number) => number;
  /** What the colours tell, for those who do not see them. */
  readonly label: string;
  /** What stands at the beginning, in the middle and at the end. */
  readonly ticks: readonly [string, string, string];
}

/** At the end of the scales of distortions. */
const DISTORTION_END = 4;

/** Of the distance to the true image, in units of the root of the target's area. */
const TRUTH_END = 0.01;

/** Of curvatures, in units of a sphere's. */
const CURVATURE_END = 100;

function logarithmic(end: number): Pick<Scale, 'colours' | 'place' | 'value'> {
  return { colours: 'rising', place: (value) => Math.log(Math.max(value, 1)) / Math.log(end), value: (place) => end ** place };
}

/** Factors from the inverse of the end through 1 to the end. */
function factors(end: number): Pick<Scale, 'colours' | 'place' | 'value'> {
  return { colours: 'diverging', place: (value) => placeOf(Math.log(value), end), value: (place) => end ** (2 * place - 1) };
}

/** Curvatures of either sign: even around 0, by their logarithm where they are large. */
const CURVATURES = {
  colours: 'diverging',
  place: (value: number) => 0.5 + Math.asinh(value) / (2 * Math.asinh(CURVATURE_END)),
  value: (place: number) => Math.sinh((2 * place - 1) * Math.asinh(CURVATURE_END)),
  ticks: [`−${CURVATURE_END}`, '0', `${CURVATURE_END} × sphere`],
} as const;

/** The scale of a heat map; `end` is that of conformal factors, which follows from the flows. */
export function scaleOf(heat: HeatMap, end = 2): Scale {
  switch (heat) {
    case 'distortion':
      return {
        ...logarithmic(DISTORTION_END),
        label: 'Colours of the distortion from 1, which is none, to 4 and more',
        ticks: ['1, none', '2', '4 and more'],
      };
    case 'angles':
      return {
        ...logarithmic(DISTORTION_END),
        label: 'Colours of the distortion of angles from 1, which is none, to 4 and more',
        ticks: ['1, none', '2', '4 and more'],
      };
    case 'areas':
      return {
        ...factors(DISTORTION_END),
        label: 'Colours of the factor of the area: shrunk to a quarter on the left, as large in the middle, four times as large on the right',
        ticks: ['1/4 of its area', '1', '4 times'],
      };
    case 'truth':
      return {
        colours: 'rising',
        place: (value) => value / TRUTH_END,
        value: (place) => place * TRUTH_END,
        label: 'Colours of the distance to the true image, from none to 1 % of the root of the area and more',
        ticks: ['0', '0.5 %', '1 % and more'],
      };
    case 'factor':
      return {
        ...factors(end),
        label: `Colours of the conformal factor: lengths shrink to 1/${end} on the left, stay in the middle, grow by ${end} on the right`,
        ticks: [`1/${end} of its length`, '1', `${end} times`],
      };
    case 'curvature':
      return { ...CURVATURES, label: 'Colours of the Gaussian curvature in units of a sphere’s of the same area: saddles on the left, flat in the middle, bulges on the right' };
    case 'flat-curvature':
      return { ...CURVATURES, label: 'Colours of the Gaussian curvature after the flow, in units of a sphere’s of the same area: flat but for the cones' };
  }
}
