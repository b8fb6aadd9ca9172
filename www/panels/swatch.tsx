/** A landmark's number in its colour. */
import type { VNode } from 'preact';
import { landmarkColour } from '../wasm/page.js';

/** The luminance from which on dark digits are easier to read than light ones (equal contrast, WCAG 2). */
const BRIGHT = 0.179;

interface SwatchProps {
  readonly number: number;
  readonly draggable?: boolean;
}

/** The number on the colour of its pin, which comes in linear RGB. */
export function Swatch({ number, draggable }: SwatchProps): VNode {
  const [red = 0, green = 0, blue = 0] = landmarkColour(number - 1);
  const luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  return (
    <span
      class={luminance > BRIGHT ? 'swatch dark-ink' : 'swatch'}
      draggable={draggable}
      style={{ backgroundColor: `color(srgb-linear ${red} ${green} ${blue})` }}
    >
      {number}
    </span>
  );
}
