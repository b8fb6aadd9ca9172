/** Plays on both meshes how they are simplified to their landmarks. */
import type { VNode } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import type { Simplifications, SimplifiedFrom } from '../compute/watch-messages.ts';
import type { Side } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import { wordsOf } from '../unions.ts';
import type { Listener, SimplificationHands } from './hands.ts';
import { usePlayed } from './played.ts';
import { countAt, stageAt, stageCount } from './stages.ts';
import type { Step } from './trails.ts';
import { historyOf, nearestVertex, trailOf } from './trails.ts';
import { Computed, Transport } from './watched.tsx';

type Place = readonly [number, number, number];

export interface SimplificationPlayerProps {
  readonly hands: SimplificationHands;
  /** The place under the mouse on both meshes, in the files' coordinates; `null` while the mouse is on neither. */
  readonly places: readonly [Place, Place] | null;
  /** Whether the map has a map file, by which the triangles of one mesh can be drawn on the other. */
  readonly isCarried: boolean;
  /** Closes the simplification. */
  readonly onClose: () => void;
}

/** The time from one stage to the next, in ms. */
const STAGE_TIME = 160;

interface PlayerProps extends Omit<SimplificationPlayerProps, 'isCarried'> {
  readonly found: Simplifications;
}

/** A vertex with its history. */
interface Trail {
  readonly steps: readonly Step[];
  readonly trail: Float32Array;
}

/** The history of the vertex at a place of one mesh. */
function trailAt(found: Simplifications, side: Side, places: SimplificationPlayerProps['places']): Trail | null {
  if (places === null) {
    return null;
  }
  const vertex = nearestVertex(found[side], places[side]);
  const steps = historyOf(found[side], vertex);
  return { steps, trail: trailOf(found[side], vertex, steps) };
}

/** A sentence about the history of the vertices under the mouse. */
function historyWords(found: Simplifications, trails: readonly [Trail | null, Trail | null]): string {
  const of = (name: string, side: Side): string => {
    const steps = trails[side]?.steps ?? [];
    const [first] = steps;
    const all = integer(found[side].collapses.length / 2);
    if (first === undefined) {
      return `On the ${name}: a landmark, which is never removed.`;
    }
    const then = steps.length === 1 ? '' : `, merged ${steps.length === 2 ? 'once' : `${integer(steps.length - 1)} times`} more until collapse ${integer(steps.at(-1)?.collapse ?? 0)}`;
    return `On the ${name}: merged into its neighbour by collapse ${integer(first.collapse)} of ${all}${then}.`;
  };
  return `${of('source', 0)} ${of('target', 1)}`;
}

function Player({ found, hands, places, onClose }: PlayerProps): VNode {
  const last = stageCount(found) - 1;
  const { time, isPlaying, rest, toggle } = usePlayed(last, STAGE_TIME);
  const stage = Math.min(Math.floor(time), last);
  const sides = useMemo(() => [stageAt(found[0], stage, last), stageAt(found[1], stage, last)] as const, [found, stage]);
  const trails = useMemo(() => [trailAt(found, 0, places), trailAt(found, 1, places)] as const, [found, places]);
  useEffect(() => {
    hands.show({ sides, trails: [trails[0]?.trail ?? null, trails[1]?.trail ?? null] });
  }, [sides, trails]);
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
      <p class="small quiet history-words">
        {places === null ? 'Point at a mesh: the way of the vertex there to its landmark is drawn.' : historyWords(found, [trails[0], trails[1]])}
      </p>
      <div class="watched-row">
        <button type="button" id="close-simplification" onClick={onClose}>
          Back to the picture
        </button>
      </div>
    </div>
  );
}

const CHOICES: Readonly<Record<SimplifiedFrom, { readonly text: string; readonly about: string }>> = {
  each: { text: 'Each by itself', about: 'Both meshes go to their own landmarks.' },
  source: { text: 'From the source', about: 'The source is simplified by its own shape; the map carries its triangles to the target.' },
  target: { text: 'From the target', about: 'The target is simplified by its own shape; the map carries its triangles to the source.' },
  both: { text: 'Jointly', about: 'The source is simplified where both shapes change least; the map carries its triangles to the target.' },
};

/** The stages of the chosen simplification, once they are computed. */
export default function SimplificationPlayer({ hands, places, isCarried, onClose }: SimplificationPlayerProps): VNode {
  const [from, setFrom] = useState<SimplifiedFrom>('each');
  return (
    <div class="watched">
      <div role="radiogroup" aria-label="What is simplified" class="simplified-from">
        {wordsOf(CHOICES).map((value) => (
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
            <span>{CHOICES[value].text}</span>
          </label>
        ))}
      </div>
      <p class="quiet small">
        {CHOICES[from].about}
        {!isCarried && ' The others need a map with a map file: of the default method, between meshes that were not repaired.'}
      </p>
      <Computed
        key={from}
        hands={{ start: (listener: Listener<Simplifications>) => hands.start(listener, from) }}
        sentence={from === 'each' ? 'Collapsing both meshes to their landmarks…' : 'Collapsing one mesh to its landmarks…'}
        onClose={onClose}
      >
        {(found) => <Player hands={hands} places={places} onClose={onClose} found={found} />}
      </Computed>
    </div>
  );
}
