/** The style in which a demo shows what it is about, where that is not the usual one. It comes and goes with the demo. */
import type { State, Style } from './state.ts';
import { INITIAL } from './state.ts';

const PICTURES: Readonly<Record<string, Partial<Style>>> = {
  'ball-cone': { surface: 'checkerboard', textureBoundary: true },
};

/** The changes of the style when a demo is opened. */
export function pictureOf({ id }: { readonly id: string }): Partial<Style> {
  return PICTURES[id] ?? {};
}

/** The changes of the style when the demo on the page is left: fields that the user has not changed since get their initial values. */
export function pictureLeft({ demo, ui: { style } }: Pick<State, 'demo' | 'ui'>): Partial<Style> {
  const picture = demo === null ? {} : pictureOf(demo);
  const keys = (Object.keys(picture) as (keyof Style)[]).filter((key) => style[key] === picture[key]);
  return Object.fromEntries(keys.map((key) => [key, INITIAL.ui.style[key]]));
}
