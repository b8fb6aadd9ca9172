/**
 * Colours of what is drawn on a canvas or leaves the page as a file, where style sheets do not reach. Those that the page shows, too,
 * are in `styles/theme.css`, and those that the views draw in Rust (`scene`); a test holds that they are the same.
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
/** Cones of positive and of negative curvature. */
export const POSITIVE: Shades = { light: '#c8402f', dark: '#ee6b58' };
export const NEGATIVE: Shades = { light: '#3556c0', dark: '#7f9bf5' };
/** Where a flat metric is cut open. */
export const CUT: Shades = { light: '#d01818', dark: '#ff5a4f' };
/** What is lit up. */
export const LIT: Shades = { light: '#c2189b', dark: '#ff5ccf' };
