/** What the surfaces show: chosen on the canvas, with a legend where colours mean something. */
import type { VNode } from 'preact';
import { shownStyle } from '../store/compared.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result, State, Style } from '../store/state.ts';
import { distortionScale } from '../wasm/page.js';
import type { PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { Check } from './controls.tsx';
import { Popover } from './popover.tsx';

const SURFACES: readonly Choice<Style['surface']>[] = [
  { value: 'shaded', text: 'Plain' },
  { value: 'look', text: 'Own colours' },
  { value: 'pattern', text: 'Pattern' },
  { value: 'checkerboard', text: 'Checkerboard' },
  { value: 'colours', text: 'Colours' },
  { value: 'distortion', text: 'Distortion' },
  { value: 'truth', text: 'Distance to the truth' },
];

/** Whether a surface can be shown now. */
function isThere(state: State, surface: Style['surface']): boolean {
  const result = shownResult(state);
  if (surface === 'look') {
    return state.meshes.some((mesh) => mesh?.look === 'colours');
  }
  if (surface === 'distortion' || surface === 'truth') {
    return result !== null && result.output[surface].length > 0;
  }
  return surface === 'shaded' || result !== null;
}

/** Whether it is known where the texture is cut that a map carries: only a map that is one-to-one has the target's cut on the source. */
function hasSeams(result: Result | null): boolean {
  return result !== null && result.output.distortion.length > 0;
}

interface SurfaceProps extends Pick<PartProps, 'state' | 'actions'> {
  /** The name of the radio buttons: those of one name exclude each other. */
  readonly group: string;
}

/** What the surfaces show. */
export function SurfaceChoice({ state, actions, group }: SurfaceProps): VNode {
  return (
    <div role="radiogroup" aria-label="Surface">
      {SURFACES.filter(({ value }) => value !== 'truth' || isThere(state, value)).map(({ value, text }) => (
        <label class="check" key={value}>
          <input
            type="radio"
            name={group}
            value={value}
            checked={state.ui.style.surface === value}
            disabled={!isThere(state, value)}
            onChange={() => {
              actions.dispatch({ kind: 'style', style: { surface: value } });
            }}
          />
          <span>{text}</span>
        </label>
      ))}
    </div>
  );
}

/** What lies on the surfaces. */
export function LineChoice({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const set = (style: Partial<Style>): void => {
    actions.dispatch({ kind: 'style', style });
  };
  const result = shownResult(state);
  const hasResult = result !== null;
  return (
    <>
      <Check name="markers" text="Landmarks" checked={state.ui.style.markers} onChange={(markers) => { set({ markers }); }} />
      <Check name="cones" text="Cones" checked={state.ui.style.cones} disabled={!hasResult} onChange={(cones) => { set({ cones }); }} />
      <Check
        name="patchLines"
        text="Patch lines"
        checked={state.ui.style.patchLines}
        disabled={!hasResult}
        onChange={(patchLines) => {
          set({ patchLines });
        }}
      />
      <Check
        name="textureBoundary"
        text="Texture boundary"
        checked={state.ui.style.textureBoundary}
        disabled={!hasSeams(result)}
        onChange={(textureBoundary) => {
          set({ textureBoundary });
        }}
      />
    </>
  );
}

/** The button on the target's view, and what it opens. */
export function PictureBar({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  if (state.meshes.includes(null)) {
    return null;
  }
  const surface = SURFACES.find(({ value }) => value === state.ui.style.surface);
  return (
    <div class="picture-bar">
      <Popover icon="picture" label={`Picture: ${surface?.text ?? ''}`} text={surface?.text ?? ''} place="up end">
        {() => (
          <>
            <p class="title">Surface</p>
            <SurfaceChoice state={state} actions={actions} group="surface" />
            <p class="title">On it</p>
            <LineChoice state={state} actions={actions} />
          </>
        )}
      </Popover>
    </div>
  );
}

/** What the scale of colours tells, with its beginning, middle and end. */
const SCALES = {
  distortion: { label: 'Colours of the distortion from 1, which is none, to 4 and more', ticks: ['1, none', '2', '4 and more'] },
  truth: {
    label: 'Colours of the distance to the true image, from none to 1 % of the root of the area and more',
    ticks: ['0', '0.5 %', '1 % and more'],
  },
} as const;

/** The renderer's colours of the distortion as a gradient. */
function scaleImage(): string {
  const colours = distortionScale();
  const stops = Array.from({ length: colours.length / 3 }, (_, k) => `color(srgb-linear ${colours.slice(3 * k, 3 * k + 3).join(' ')})`);
  return `linear-gradient(90deg, ${stops.join(', ')})`;
}

/** What the colours mean. */
export function Legend({ state }: Pick<PartProps, 'state'>): VNode | null {
  const hasResult = shownResult(state) !== null;
  const { surface, textureBoundary } = shownStyle(state);
  const scale = (surface === 'distortion' || surface === 'truth') && isThere(state, surface) ? SCALES[surface] : null;
  const cones = hasResult && state.ui.style.cones;
  const boundary = textureBoundary && hasSeams(shownResult(state));
  if (scale === null && !cones && !boundary) {
    return null;
  }
  return (
    <div class="legend small">
      {scale !== null && (
        <div class="scale" role="img" aria-label={scale.label}>
          <div class="bar" style={{ backgroundImage: scaleImage() }} />
          <div class="ticks">
            {scale.ticks.map((tick) => (
              <span key={tick}>{tick}</span>
            ))}
          </div>
        </div>
      )}
      {cones && (
        <p>
          <span class="dot positive" />
          bulging, <span class="dot negative" />
          saddle-like cones
        </p>
      )}
      {boundary && (
        <p>
          <span class="stroke" />
          where the texture is cut
        </p>
      )}
    </div>
  );
}
