/** The colours of the base domain, and its picture as a file. */
import type { Lighting, Shades } from '../colours.ts';
import { FACE, GROUND, INK, LIT, LIT_FACE, NEGATIVE, POSITIVE, RIM, SIDE } from '../colours.ts';
import { escaped } from '../svg.ts';
import type { Ball, Facet, Picture, Spot } from './picture.ts';

export interface Palette {
  /** A triangle in the shade and in full light. */
  readonly face: Lighting;
  readonly side: string;
  readonly rim: string;
  readonly positive: string;
  readonly negative: string;
  /** The colour of a part that is lit up, the same as on the meshes. */
  readonly lit: string;
  readonly litFace: Lighting;
  readonly ink: string;
  readonly ground: string;
}

function paletteOf(shade: keyof Shades): Palette {
  return {
    face: FACE[shade],
    side: SIDE[shade],
    rim: RIM[shade],
    positive: POSITIVE[shade],
    negative: NEGATIVE[shade],
    lit: LIT[shade],
    litFace: LIT_FACE[shade],
    ink: INK[shade],
    ground: GROUND[shade],
  };
}

export const LIGHT = paletteOf('light');
export const DARK = paletteOf('dark');

/** A mixture of two colours; share 0 gives the first. */
export function mixed([from, to]: Lighting, share: number): string {
  const part = (k: 0 | 1 | 2): number => Math.round(from[k] + share * (to[k] - from[k]));
  return `rgb(${part(0)} ${part(1)} ${part(2)})`;
}

function pair({ x, y }: Spot): string {
  return `${x.toFixed(2)} ${y.toFixed(2)}`;
}

/** The outline of a facet. */
export function outline({ corners }: Facet): string {
  return `M${corners.map(pair).join('L')}Z`;
}

/** A stroke. */
export function stroke({ from, to }: { readonly from: Spot; readonly to: Spot }): string {
  return `M${pair(from)}L${pair(to)}`;
}

/** The sides that border a facet. */
export function strokes({ sides }: Facet): string {
  return sides.map(stroke).join('');
}

function ballMarkup({ at, radius, sign, isHidden }: Ball, name: string, palette: Palette): string {
  if (isHidden) {
    return '';
  }
  const place = `x="${(at.x + radius + 3).toFixed(2)}" y="${(at.y + 4).toFixed(2)}"`;
  const label = `<text ${place} fill="${palette.ink}" stroke="${palette.ground}" stroke-width="3" paint-order="stroke">${escaped(name)}</text>`;
  return `<circle cx="${at.x.toFixed(2)}" cy="${at.y.toFixed(2)}" r="${radius.toFixed(2)}" fill="${palette[sign]}" stroke="${palette.rim}"/>${label}`;
}

/** The picture as a self-contained SVG, dark on white, with the names of the visible cones. */
export function pictureSvg(picture: Picture, size: { readonly width: number; readonly height: number }, names: readonly string[]): string {
  const { width, height } = size;
  const facets = picture.facets.map((facet) => {
    const fill = mixed(LIGHT.face, facet.light);
    // A thin stroke in the facet's own colour closes the seam to the next facet.
    return `<path d="${outline(facet)}" fill="${fill}" stroke="${fill}" stroke-width="0.6"/><path d="${strokes(facet)}" stroke="${LIGHT.side}" fill="none"/>`;
  });
  const balls = picture.balls.map((ball) => ballMarkup(ball, names[ball.cone] ?? String(ball.cone + 1), LIGHT));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="11" stroke-linejoin="round" stroke-linecap="round"><title>Base domain</title><rect width="${width}" height="${height}" fill="${LIGHT.ground}"/>${facets.join('')}${balls.join('')}</svg>\n`;
}
