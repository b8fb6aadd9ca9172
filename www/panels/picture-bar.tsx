/** The menu of what the surfaces show, and the legend of its colours. */
import type { VNode } from 'preact';
import type { Scale } from '../heat/scales.ts';
import { scaleOf } from '../heat/scales.ts';
import { gradientOf, scaleEnd } from '../method/factors.ts';
import { shownStyle } from '../store/compared.ts';
import { shownFlows } from '../store/flat.ts';
import { shownResult } from '../store/staleness.ts';
import type { HeatMap, PlainSurface, Result, State, Style, Texture } from '../store/state.ts';
import { isFlowHeat, isHeatMap, isTexture, isThere } from '../store/surfaces.ts';
import { factorScale, risingScale } from '../wasm/page.js';
import type { PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { Check, choicesOf } from './controls.tsx';
import { Popover } from './popover.tsx';
import { TextureControls } from './texture-controls.tsx';

type Surface = Choice<Style['surface']>;

const PLAIN: Readonly<Record<PlainSurface, string>> = {
  shaded: 'Plain',
  look: 'Own colours',
  pattern: 'Pattern',
  colours: 'Colours',
};

/** The textures that can lie on the flat metric. */
const TEXTURE_CHOICES: readonly Surface[] = choicesOf<Texture>({
  checkerboard: 'Checkerboard',
  circles: 'Circles',
  ribbons: 'Ribbons',
  coordinates: 'Coordinates',
  picture: 'Your picture',
});

const HEAT_MAPS: Readonly<Record<HeatMap, string>> = {
  distortion: 'Distortion',
  angles: 'Angles',
  areas: 'Areas',
  factor: 'Conformal factor',
  curvature: 'Curvature',
  'flat-curvature': 'Curvature, flat',
  truth: 'Distance to the truth',
};

/** What the surfaces can show, in groups with their titles. */
const GROUPS: readonly { readonly title: string | null; readonly surfaces: readonly Surface[] }[] = [
  {
    title: null,
    surfaces: choicesOf(PLAIN),
  },
  {
    title: 'Texture of the flat metric',
    surfaces: TEXTURE_CHOICES,
  },
  {
    title: 'Heat map',
    surfaces: choicesOf(HEAT_MAPS),
  },
];

/** Whether it is known where the carried texture is cut: only a map that is one-to-one carries the target's cut to the source. */
function hasSeams(result: Result | null): boolean {
  return result !== null && result.output.distortion.length > 0;
}

interface SurfaceProps extends Pick<PartProps, 'state' | 'actions'> {
  /** The name of the radio buttons: only one of those with the same name is checked. */
  readonly group: string;
}

/** The choice of what the surfaces show. */
export function SurfaceChoice({ state, actions, group }: SurfaceProps): VNode {
  const choose = (surface: Style['surface']): void => {
    actions.dispatch({ kind: 'style', style: { surface } });
  };
  const hasControls = shownResult(state) !== null && isTexture(state.ui.style.surface);
  return (
    <div role="radiogroup" aria-label="Surface" class="surfaces">
      {GROUPS.map(({ title, surfaces }) => (
        <div key={title} class="surface-group">
          {title !== null && <p class="title">{title}</p>}
          {surfaces
            .filter(({ value }) => value !== 'truth' || isThere(state, value))
            .map(({ value, text }) => (
              <label class="check" key={value}>
                <input
                  type="radio"
                  name={group}
                  value={value}
                  checked={state.ui.style.surface === value}
                  disabled={!isThere(state, value)}
                  onChange={() => {
                    choose(value);
                  }}
                />
                <span>{text}</span>
              </label>
            ))}
          {surfaces === TEXTURE_CHOICES && hasControls && <TextureControls state={state} actions={actions} />}
        </div>
      ))}
    </div>
  );
}

/** The choice of the lines that are drawn on the surfaces. */
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

/** The button on the target's view, and the menu that it opens. */
export function PictureBar({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode | null {
  if (state.meshes.includes(null)) {
    return null;
  }
  const surface = GROUPS.flatMap(({ surfaces }) => surfaces).find(({ value }) => value === state.ui.style.surface);
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

/** The scale of the heat map that is shown; `null` where none is shown. */
function shownScale(state: State): Scale | null {
  const { surface } = shownStyle(state);
  if (!isHeatMap(surface) || !isThere(state, surface)) {
    return null;
  }
  const flows = shownFlows(state);
  return isFlowHeat(surface) && flows === null ? null : scaleOf(surface, flows === null ? undefined : scaleEnd(flows));
}

/** The progress of the flows that a heat map waits for, or why there are none; `null` where no heat map waits. */
function flowWords(state: State): string | null {
  const { surface } = shownStyle(state);
  const { flattening } = state;
  if (!isFlowHeat(surface) || flattening === null) {
    return null;
  }
  const { progress } = flattening;
  switch (progress.kind) {
    case 'computing':
      return `Computing both flows: ${Math.round(100 * progress.share)} %`;
    case 'failed':
      return progress.sentence;
    case 'there':
      return null;
  }
}

/** The legend of the colours. */
export function Legend({ state }: Pick<PartProps, 'state'>): VNode | null {
  const hasResult = shownResult(state) !== null;
  const { textureBoundary } = shownStyle(state);
  const scale = shownScale(state);
  const words = flowWords(state);
  const cones = hasResult && state.ui.style.cones;
  const boundary = textureBoundary && hasSeams(shownResult(state));
  if (scale === null && words === null && !cones && !boundary) {
    return null;
  }
  return (
    <div class="legend-line">
      <div class="legend small">
        {words !== null && <p role="status">{words}</p>}
        {scale !== null && (
          <div class="scale" role="img" aria-label={scale.label}>
            <div class="bar" style={{ backgroundImage: gradientOf(scale.colours === 'rising' ? risingScale() : factorScale()) }} />
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
    </div>
  );
}
