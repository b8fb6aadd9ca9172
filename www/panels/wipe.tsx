/**
 * A line that is dragged across the source's view: to the left of it the source is drawn plain, to the right with what the map carries to
 * it.
 */
import type { VNode } from 'preact';
import { useRef, useState } from 'preact/hooks';
import { shownResult } from '../store/staleness.ts';
import type { State } from '../store/state.ts';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';
import { Icon } from './icons.tsx';

type Props = Pick<PartProps, 'state' | 'actions'>;

/** The step of an arrow key, as a share of the view's width. */
const KEY_STEP = 0.02;
/** The number of steps to which a position in the view is rounded: finer than a pixel. */
const STEPS = 10_000;
/** The position of the line when it is switched on. */
const MIDDLE = 0.5;

/** Whether the surfaces show anything that a map carries. */
export function canWipe(state: State): boolean {
  return shownResult(state) !== null && state.ui.style.surface !== 'shaded';
}

/** The position to which a key moves the line; `null` for other keys. */
export function afterKey(key: string, wipe: number): number | null {
  switch (key) {
    case 'ArrowLeft':
    case 'ArrowDown':
      return Math.max(0, wipe - KEY_STEP);
    case 'ArrowRight':
    case 'ArrowUp':
      return Math.min(1, wipe + KEY_STEP);
    case 'Home':
      return 0;
    case 'End':
      return 1;
    default:
      return null;
  }
}

/** The button that shows and hides the line. */
export function WipeButton({ state, actions }: Props): VNode {
  const isOn = state.ui.style.wipe !== null;
  return (
    <IconButton
      icon="wipe"
      id="wipe"
      label="Wipe what the map carries across the source"
      pressed={isOn}
      disabled={!canWipe(state)}
      onClick={() => {
        actions.dispatch({ kind: 'style', style: { wipe: isOn ? null : MIDDLE } });
      }}
    />
  );
}

/** The line on the source's view. */
export function WipeLine({ state, actions }: Props): VNode | null {
  const { wipe } = state.ui.style;
  const [held, setHeld] = useState(false);
  const element = useRef<HTMLDivElement>(null);
  if (wipe === null || !canWipe(state)) {
    return null;
  }
  const put = (share: number): void => {
    const bounded = Math.min(1, Math.max(0, share));
    actions.dispatch({ kind: 'style', style: { wipe: Math.round(STEPS * bounded) / STEPS } });
  };
  const release = (): void => {
    setHeld(false);
  };
  return (
    <div
      ref={element}
      class={held ? 'wipe-line held' : 'wipe-line'}
      style={{ '--wipe': String(wipe) }}
      role="slider"
      tabIndex={0}
      aria-label="Border between the plain source and the picture that the map carries onto it"
      aria-orientation="horizontal"
      aria-valuenow={Math.round(100 * wipe)}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuetext={`${Math.round(100 * wipe)} % of the view shows the plain source`}
      title="Drag: to the left of it is the plain source, to the right the picture that the map carries there"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        setHeld(true);
      }}
      onPointerMove={(event) => {
        const view = element.current?.parentElement?.getBoundingClientRect();
        if (held && view !== undefined) {
          put((event.clientX - view.left) / view.width);
        }
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onKeyDown={(event) => {
        const next = afterKey(event.key, wipe);
        if (next !== null) {
          event.preventDefault();
          put(next);
        }
      }}
    >
      <span class="grip">
        <Icon name="wipe" />
      </span>
    </div>
  );
}
