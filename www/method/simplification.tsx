/** How both meshes are simplified to their landmarks, played on them. */
import type { VNode } from 'preact';
import { useEffect, useMemo } from 'preact/hooks';
import type { Simplifications } from '../compute/watch-messages.ts';
import { integer } from '../numbers.ts';
import type { WatchHands } from './hands.ts';
import { usePlayed } from './played.ts';
import { countAt, stageAt, stageCount } from './stages.ts';
import { Computed, Transport } from './watched.tsx';

export interface SimplificationPlayerProps {
  readonly hands: WatchHands<'simplifications'>;
  /** Leaves it. */
  readonly onClose: () => void;
}

/** From one stage to the next, in ms. */
const STAGE_TIME = 160;

interface PlayerProps extends SimplificationPlayerProps {
  readonly found: Simplifications;
}

function Player({ found, hands, onClose }: PlayerProps): VNode {
  const last = stageCount(found) - 1;
  const { time, isPlaying, rest, toggle } = usePlayed(last, STAGE_TIME);
  const stage = Math.min(Math.floor(time), last);
  const sides = useMemo(() => [stageAt(found[0], stage, last), stageAt(found[1], stage, last)] as const, [found, stage]);
  useEffect(() => {
    hands.show({ sides });
  }, [sides]);
  useEffect(
    () => () => {
      hands.show(null);
    },
    [],
  );
  const words = `${integer(countAt(found[0], stage, last))} triangles on the source, ${integer(countAt(found[1], stage, last))} on the target`;
  return (
    <div class="watched">
      <Transport name="simplification" {...{ last, time, isPlaying, words, rest, toggle }} />
      <p class="small stage-words" role="status">
        {words}
      </p>
      <div class="watched-row">
        <button type="button" id="close-simplification" onClick={onClose}>
          Back to the picture
        </button>
      </div>
    </div>
  );
}

/** The stages, once they are computed. */
export default function SimplificationPlayer({ hands, onClose }: SimplificationPlayerProps): VNode {
  return (
    <Computed hands={hands} sentence="Collapsing both meshes to their landmarks…" onClose={onClose}>
      {(found) => <Player hands={hands} onClose={onClose} found={found} />}
    </Computed>
  );
}
