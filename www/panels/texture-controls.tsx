/** The controls for how a texture lies on the flat metric: its scale, turn and shift, and a picture of the user. */
import type { VNode } from 'preact';
import type { TexturePlace } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { choose } from './inputs.tsx';

/** The least number of cells of a texture, the number of the slider's steps, and the largest number of cells. */
const FEWEST = 4;
const CELL_STEPS = 60;
const MOST = 324;

function cellsAt(step: number): number {
  return FEWEST * (MOST / FEWEST) ** (step / CELL_STEPS);
}

function stepOf(cells: number): number {
  return Math.round((CELL_STEPS * Math.log(cells / FEWEST)) / Math.log(MOST / FEWEST));
}

interface SliderProps {
  readonly name: string;
  readonly text: string;
  readonly value: number;
  readonly ends: readonly [number, number];
  readonly step: number;
  readonly words: string;
  readonly onChange: (value: number) => void;
}

function Slider({ name, text, value, ends, step, words, onChange }: SliderProps): VNode {
  return (
    <label class="slider">
      <span>{text}</span>
      <input
        type="range"
        name={name}
        min={ends[0]}
        max={ends[1]}
        step={step}
        value={value}
        aria-valuetext={words}
        onInput={(event) => {
          onChange(Number(event.currentTarget.value));
        }}
      />
    </label>
  );
}

/** The controls for the texture that is shown. */
export function TextureControls({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const { texturePicture } = state;
  const { texture } = state.ui.style;
  const set = (change: Partial<TexturePlace>): void => {
    actions.dispatch({ kind: 'style', style: { texture: { ...texture, ...change } } });
  };
  const { cells, turn, x, y } = texture;
  return (
    <div class="texture-place" role="group" aria-label="How the texture lies">
      <Slider
        name="texture-cells"
        text="Cells"
        value={stepOf(cells)}
        ends={[0, CELL_STEPS]}
        step={1}
        words={`${Math.round(cells)} cells across`}
        onChange={(step) => {
          set({ cells: cellsAt(step) });
        }}
      />
      <Slider
        name="texture-turn"
        text="Turn"
        value={turn}
        ends={[-180, 180]}
        step={1}
        words={`${turn} degrees`}
        onChange={(degrees) => {
          set({ turn: degrees });
        }}
      />
      <Slider
        name="texture-x"
        text="Shift across"
        value={x}
        ends={[-9, 9]}
        step={0.05}
        words={`${x} cells`}
        onChange={(shift) => {
          set({ x: shift });
        }}
      />
      <Slider
        name="texture-y"
        text="Shift up"
        value={y}
        ends={[-9, 9]}
        step={0.05}
        words={`${y} cells`}
        onChange={(shift) => {
          set({ y: shift });
        }}
      />
      <button
        type="button"
        onClick={() => {
          choose('texture-file');
        }}
      >
        {texturePicture === null ? 'Lay a picture of yours on it…' : 'Another picture…'}
      </button>
    </div>
  );
}
