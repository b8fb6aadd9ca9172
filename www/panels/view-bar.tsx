/** The buttons on a view for its camera. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import type { Side } from '../landmarks.ts';
import { isWhole, otherSide, PAIRS_TO_TURN } from '../landmarks.ts';
import { shownDefects } from '../store/defects.ts';
import { shownResult } from '../store/staleness.ts';
import type { Axis, State } from '../store/state.ts';
import type { LookFrom } from '../wasm/page.js';
import type { PartProps } from './actions.ts';
import { choicesOf, IconButton } from './controls.tsx';
import { SIDE_NAMES } from './names.ts';
import { Popover } from './popover.tsx';

type Props = { readonly side: Side } & PartProps;

const DIRECTIONS: Readonly<Record<LookFrom, string>> = {
  front: 'Front',
  back: 'Back',
  left: 'Left',
  right: 'Right',
  top: 'Top',
  bottom: 'Bottom',
};

const AXES: Readonly<Record<Axis, string>> = {
  y: 'Y up',
  z: 'Z up',
  x: 'X up',
  '-y': 'Y down',
  '-z': 'Z down',
  '-x': 'X down',
};

const LINKS: Readonly<Record<State['ui']['link'], string>> = {
  linked: 'Turn both together',
  map: 'Both to corresponding places',
  free: 'Each by itself',
};

/** The turn of one press, in degrees; six presses turn by a right angle. */
const ROLL = 15;

function Sides({ state, actions, side }: Props): VNode {
  const pairs = state.pairs.filter(isWhole).length;
  return (
    <Popover icon="sides" label={`Look at the ${SIDE_NAMES[side]} from a side`} place="up start">
      {() => (
        <>
          <div class="tiles">
            {choicesOf(DIRECTIONS).map(({ value: from, text }) => (
              <button
                key={from}
                type="button"
                onClick={() => {
                  actions.camera(side, { kind: 'look', from });
                }}
              >
                {text}
              </button>
            ))}
          </div>
          <button
            type="button"
            disabled={pairs < PAIRS_TO_TURN}
            title={`By the landmark pairs, of which it needs ${PAIRS_TO_TURN}`}
            onClick={() => {
              actions.camera(side, { kind: 'as-other' });
            }}
          >
            As the {SIDE_NAMES[otherSide(side)]} is seen
          </button>
        </>
      )}
    </Popover>
  );
}

/** The choice of the axis that points up, with the axis that the shape suggests. The shape is examined when the box opens. */
function AxisChoice({ state, actions, side }: Props): VNode {
  const [proposed] = useState(() => actions.proposedUp(side));
  return (
    <>
      <p class="title">Turn upright</p>
      <div class="tiles">
        {choicesOf(AXES).map(({ value: axis, text }) => (
          <button
            key={axis}
            type="button"
            aria-pressed={state.up[side] === axis}
            onClick={() => {
              actions.dispatch({ kind: 'up', side, axis });
            }}
          >
            {text}
          </button>
        ))}
      </div>
      {proposed !== null && proposed !== state.up[side] && (
        <p class="small title">By its shape: {AXES[proposed]}</p>
      )}
    </>
  );
}

function Upright(props: Props): VNode {
  const { actions, side } = props;
  return (
    <Popover icon="upright" label={`Turn the ${SIDE_NAMES[side]} upright`} place="up start">
      {() => (
        <>
          <AxisChoice {...props} />
          <p class="title">Turn the picture</p>
          <div class="row">
            <IconButton
              icon="rollLeft"
              label="Turn the picture to the left (Q)"
              onClick={() => {
                actions.camera(side, { kind: 'roll', degrees: ROLL });
              }}
            />
            <IconButton
              icon="roll"
              label="Turn the picture to the right (E)"
              onClick={() => {
                actions.camera(side, { kind: 'roll', degrees: -ROLL });
              }}
            />
            <button
              type="button"
              class="bare"
              onClick={() => {
                actions.camera(side, { kind: 'reset' });
              }}
            >
              As at first
            </button>
          </div>
        </>
      )}
    </Popover>
  );
}

function Link({ state, actions }: Props): VNode {
  const hasMap = shownResult(state) !== null;
  return (
    <Popover icon={state.ui.link === 'free' ? 'unlink' : 'link'} label="Link the cameras" place="up start">
      {(close) =>
        choicesOf(LINKS).map(({ value: link, text }) => (
          <button
            key={link}
            type="button"
            aria-pressed={state.ui.link === link}
            disabled={link === 'map' && !hasMap}
            onClick={() => {
              close();
              actions.dispatch({ kind: 'ui', ui: { link } });
            }}
          >
            {text}
          </button>
        ))
      }
    </Popover>
  );
}

function Alone({ shell, side }: Props): VNode {
  const alone = side === 0 ? 1 : 0;
  const isAlone = shell.state.split === alone;
  return (
    <IconButton
      icon="wide"
      label={isAlone ? 'Show both views' : `Show the ${SIDE_NAMES[side]} alone`}
      pressed={isAlone}
      onClick={() => {
        shell.set({ split: isAlone ? 0.5 : alone });
      }}
    />
  );
}

/** The bar of one view. */
export function ViewBar(props: Props): VNode | null {
  const { state, actions, side } = props;
  if (state.meshes[side] === null && shownDefects(state, side) === null) {
    return null;
  }
  return (
    <div class="view-bar" role="group" aria-label={`Camera of the ${SIDE_NAMES[side]}`}>
      <IconButton
        icon="fit"
        label={`Fit the ${SIDE_NAMES[side]} into its view (F)`}
        onClick={() => {
          actions.camera(side, { kind: 'fit' });
        }}
      />
      <Sides {...props} />
      <Upright {...props} />
      {side === 0 && <Link {...props} />}
      <Alone {...props} />
    </div>
  );
}
