/** The scales of heat maps: they convert values to places on a scale of colours, from 0 to 1, and back. */
import { placeOf } from '../method/factors.ts';
import type { HeatMap } from '../store/state.ts';

export interface Scale {
  /** The colours rise from little to much, or diverge from shrinking to growing. */
  readonly colours: 'rising' | 'diverging';
  /** The place of a value on the scale; below 0 or above 1 where it is beyond an end. */
  readonly place: (value: number) => number;
  /** The value at a place. */
  readonly value: (place: number) => number;
  /** The meaning of the colours, for readers who do not see them. */
  readonly label: string;
  /** The labels at the beginning, in the middle and at the end. */
  readonly ticks: readonly [string, string, string];
}

/** The value at the end of the scales of distortions. */
const DISTORTION_END = 4;

/** The distance to the true image at the end of its scale, in units of the root of the target's area. */
const TRUTH_END = 0.01;

/** The curvature at the end of its scale, in units of the curvature of a sphere of the same area. */
const CURVATURE_END = 100;

function logarithmic(end: number): Pick<Scale, 'colours' | 'place' | 'value'> {
  return { colours: 'rising', place: (value) => Math.log(Math.max(value, 1)) / Math.log(end), value: (place) => end ** place };
}

/** A scale of factors from the inverse of the end through 1 to the end. */
function factors(end: number): Pick<Scale, 'colours' | 'place' | 'value'> {
  return { colours: 'diverging', place: (value) => placeOf(Math.log(value), end), value: (place) => end ** (2 * place - 1) };
}

/** A scale of curvatures of either sign: linear around 0, logarithmic where they are large. */
const CURVATURES = {
  colours: 'diverging',
  place: (value: number) => 0.5 + Math.asinh(value) / (2 * Math.asinh(CURVATURE_END)),
  value: (place: number) => Math.sinh((2 * place - 1) * Math.asinh(CURVATURE_END)),
  ticks: [`−${CURVATURE_END}`, '0', `${CURVATURE_END} × sphere`],
} as const;

/** The scale of a heat map; `end` is the end of the scale of conformal factors, which follows from the flows. */
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
