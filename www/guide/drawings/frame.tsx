/** The elements of the guide's drawings: shapes, paths and words on a sheet with y upwards, and a slider beneath it. */
import type { ComponentChildren, VNode } from 'preact';
import { useId } from 'preact/hooks';
import type { Point } from '../geometry.ts';

/** The sheet's size, in the drawing's own units. */
export const WIDTH = 280;
export const HEIGHT = 168;

function written(points: readonly Point[]): string {
  return points.map(({ x, y }) => `${x.toFixed(2)},${(HEIGHT - y).toFixed(2)}`).join(' ');
}

/** A closed shape. */
export function Shape({ points, look }: { readonly points: readonly Point[]; readonly look: string }): VNode {
  return <polygon class={look} points={written(points)} />;
}

/** A path from point to point. */
export function Path({ points, look }: { readonly points: readonly Point[]; readonly look: string }): VNode {
  return <polyline class={look} points={written(points)} />;
}

export function Dot({ at, look, size = 3.5 }: { readonly at: Point; readonly look: string; readonly size?: number }): VNode {
  return <circle class={look} cx={at.x.toFixed(2)} cy={(HEIGHT - at.y).toFixed(2)} r={size.toFixed(2)} />;
}

export function Ring({ at, radius, look }: { readonly at: Point; readonly radius: number; readonly look: string }): VNode {
  return <circle class={look} cx={at.x.toFixed(2)} cy={(HEIGHT - at.y).toFixed(2)} r={radius.toFixed(2)} />;
}

/** Words on the sheet, centred at a point. */
export function Words({ at, children }: { readonly at: Point; readonly children: string }): VNode {
  return (
    <text x={at.x.toFixed(2)} y={(HEIGHT - at.y).toFixed(2)} text-anchor="middle">
      {children}
    </text>
  );
}

interface DrawingProps {
  /** What the drawing shows, for readers who do not see it. */
  readonly says: string;
  readonly children: ComponentChildren;
}

/** The sheet. */
export function Drawing({ says, children }: DrawingProps): VNode {
  return (
    <svg class="drawing" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={says}>
      {children}
    </svg>
  );
}

interface SliderProps {
  readonly label: string;
  readonly value: number;
  /** The least value, the largest value and the step between values. */
  readonly range: readonly [number, number, number];
  /** The value in words. */
  readonly text: string;
  readonly onInput: (value: number) => void;
}

export function Slider({ label, value, range, text, onInput }: SliderProps): VNode {
  const id = useId();
  const [min, max, step] = range;
  return (
    <div class="slider">
      <label for={id}>{label}</label>
      <input
        id={id}
        type="range"
        min={min}
        max={max}
        step={step}
        value={value}
        aria-valuetext={text}
        onInput={(event) => {
          onInput(event.currentTarget.valueAsNumber);
        }}
      />
      <span class="value">{text}</span>
    </div>
  );
}
