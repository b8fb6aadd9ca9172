/** How both meshes are simplified to their landmarks, played on them. */
import type { VNode } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import type { Simplifications, SimplifiedFrom } from '../compute/watch-messages.ts';
import { integer } from '../numbers.ts';
import type { Listener, SimplificationHands } from './hands.ts';
import { usePlayed } from './played.ts';
import { countAt, stageAt, stageCount } from './stages.ts';
import { Computed, Transport } from './watched.tsx';

export interface SimplificationPlayerProps {
  readonly hands: SimplificationHands;
  /** Whether the map can draw one mesh on the other: it has a map file. */
  readonly isCarried: boolean;
  /** Leaves it. */
  readonly onClose: () => void;
}

/** From one stage to the next, in ms. */
const STAGE_TIME = 160;

interface PlayerProps extends Omit<SimplificationPlayerProps, 'isCarried'> {
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

const CHOICES: readonly (readonly [SimplifiedFrom, string, string])[] = [
  ['each', 'Each by itself', 'Both meshes go to their own landmarks.'],
  ['source', 'From the source', 'The source is simplified by its own shape; the map carries its triangles to the target.'],
  ['target', 'From the target', 'The target is simplified by its own shape; the map carries its triangles to the source.'],
  ['both', 'Jointly', 'The source is simplified where both shapes change least; the map carries its triangles to the target.'],
];

/** The stages, once they are computed, of what is chosen. */
export default function SimplificationPlayer({ hands, isCarried, onClose }: SimplificationPlayerProps): VNode {
  const [from, setFrom] = useState<SimplifiedFrom>('each');
  return (
    <div class="watched">
      <div role="radiogroup" aria-label="What is simplified" class="simplified-from">
        {CHOICES.map(([value, text]) => (
          <label class="check" key={value}>
            <input
              type="radio"
              name="simplified-from"
              value={value}
              checked={from === value}
              disabled={!isCarried && value !== 'each'}
              onChange={() => {
                setFrom(value);
              }}
            />
            <span>{text}</span>
          </label>
        ))}
      </div>
      <p class="quiet small">
        {CHOICES.find(([value]) => value === from)?.[2]}
        {!isCarried && ' The others need a map with a map file: of the default method, between meshes that were not repaired.'}
      </p>
      <Computed
        key={from}
        hands={{ start: (listener: Listener<Simplifications>) => hands.start(listener, from) }}
        sentence={from === 'each' ? 'Collapsing both meshes to their landmarks…' : 'Collapsing one mesh to its landmarks…'}
        onClose={onClose}
      >
        {(found) => <Player hands={hands} onClose={onClose} found={found} />}
      </Computed>
    </div>
  );
}
