/** The picture in which a demo shows what it is about, where that is not the usual one. It comes and goes with the demo. */
import type { State, Style } from './state.ts';
import { INITIAL } from './state.ts';

const PICTURES: Readonly<Record<string, Partial<Style>>> = {
  'ball-cone': { surface: 'checkerboard', textureBoundary: true },
};

/** What of the style changes as a demo comes. */
export function pictureOf({ id }: { readonly id: string }): Partial<Style> {
  return PICTURES[id] ?? {};
}

/** What of the style changes as the demo on the page goes: what was not chosen meanwhile is as at the start. */
export function pictureLeft({ demo, ui: { style } }: Pick<State, 'demo' | 'ui'>): Partial<Style> {
  const picture = demo === null ? {} : pictureOf(demo);
  const keys = (Object.keys(picture) as (keyof Style)[]).filter((key) => style[key] === picture[key]);
  return Object.fromEntries(keys.map((key) => [key, INITIAL.ui.style[key]]));
}
