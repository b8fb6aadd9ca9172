/** The slider that moves the source to the target's shape, and a button that plays this there and back. */
import type { VNode } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import type { PartProps } from './actions.ts';
import { IconButton } from './controls.tsx';
import { play } from './playback.ts';

/** The number of the slider's steps over the whole way. */
const STEPS = 100;

function inWords(share: number): string {
  if (share === 0 || share === 1) {
    return share === 0 ? 'the source’s shape' : 'the target’s shape';
  }
  return `${Math.round(STEPS * share)} % of the way to the target’s shape`;
}

/** The share of the way while it plays, `null` while it does not; and the function that starts and stops it. */
function usePlayback({ state, actions }: Pick<PartProps, 'state' | 'actions'>): readonly [number | null, () => void] {
  const [share, setShare] = useState<number | null>(null);
  const end = useRef<(() => void) | null>(null);
  const stop = (): void => {
    end.current?.();
    end.current = null;
    setShare(null);
  };
  useEffect(() => stop, []);
  const rest = (morph: number): void => {
    stop();
    // The views may show another share than the one that the state has.
    actions.morph(morph);
    actions.dispatch({ kind: 'style', style: { morph } });
  };
  const toggle = (): void => {
    const { morph } = state.ui.style;
    if (share !== null) {
      rest(Math.round(STEPS * share) / STEPS);
    } else if (window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
      rest(morph < 0.5 ? 1 : 0);
    } else {
      setShare(morph);
      end.current = play(morph, {
        moved: (next) => {
          setShare(next);
          actions.morph(next);
        },
        ended: () => {
          rest(0);
        },
      });
    }
  };
  return [share, toggle];
}

/** The slider and the button. */
export function Morph({ state, actions }: Pick<PartProps, 'state' | 'actions'>): VNode {
  const [playing, toggle] = usePlayback({ state, actions });
  const share = playing ?? state.ui.style.morph;
  return (
    <>
      <IconButton
        icon={playing === null ? 'play' : 'pause'}
        id="play-morph"
        label={playing === null ? 'Play the source into the target’s shape and back' : 'Stop here'}
        onClick={toggle}
      />
      <input
        type="range"
        name="morph"
        min={0}
        max={STEPS}
        value={Math.round(STEPS * share)}
        aria-label="Shape of the source"
        aria-valuetext={inWords(share)}
        title="From the source’s shape to the target’s"
        onInput={(event) => {
          const morph = Number(event.currentTarget.value) / STEPS;
          if (playing !== null) {
            toggle();
          }
          actions.dispatch({ kind: 'style', style: { morph } });
        }}
      />
    </>
  );
}
