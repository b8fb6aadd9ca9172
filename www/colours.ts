/**
 * The colours of canvas drawings and of files that leave the page, which style sheets do not reach. Those that also appear on the page are
 * in `styles/theme.css`, and those that the views draw are in Rust (`scene`); a test holds that they are the same.
 */

/** A colour on a light ground and on a dark one. */
export interface Shades {
  readonly light: string;
  readonly dark: string;
}

export const INK: Shades = { light: '#1b2126', dark: '#e9ecef' };
export const QUIET: Shades = { light: '#57626c', dark: '#a0abb6' };
export const LINE: Shades = { light: '#dde1e5', dark: '#2c323a' };
export const ACCENT: Shades = { light: '#0b678a', dark: '#63c3e8' };
/** Doubtful places, and the second of two curves. */
export const DOUBT: Shades = { light: '#8a5300', dark: '#f0b863' };
/** Cones of positive and of negative curvature. */
export const POSITIVE: Shades = { light: '#c8402f', dark: '#ee6b58' };
export const NEGATIVE: Shades = { light: '#3556c0', dark: '#7f9bf5' };
/** The lines where a flat metric is cut open. */
export const CUT: Shades = { light: '#d01818', dark: '#ff5a4f' };
/** Parts that are lit up. */
export const LIT: Shades = { light: '#c2189b', dark: '#ff5ccf' };

/** The ground of pictures that leave the page as files. */
export const PAPER = '#ffffff';
/** The ground of the pictures of the base domain; on a dark page the same as in the views. */
export const GROUND: Shades = { light: PAPER, dark: '#1b1e24' };
/** The sides of base triangles, and the outlines of the balls at their corners. */
export const SIDE: Shades = { light: '#3a3f45', dark: '#14161a' };
export const RIM: Shades = { light: PAPER, dark: '#14161a' };

/** Red, green and blue, 0 to 255. */
export type Channels = readonly [number, number, number];
/** A surface in the shade and in full light. */
export type Lighting = readonly [Channels, Channels];

/** Base triangles, and those that are lit up, on a light ground and on a dark one. */
export const FACE: Readonly<Record<keyof Shades, Lighting>> = {
  light: [[128, 122, 112], [232, 226, 215]],
  dark: [[66, 62, 56], [176, 168, 155]],
};
export const LIT_FACE: Readonly<Record<keyof Shades, Lighting>> = {
  light: [[142, 34, 116], [236, 120, 206]],
  dark: [[122, 24, 98], [240, 110, 205]],
};
