/** The frame of a part of the method that is watched: its progress while it is computed, then its content. */
import type { ComponentChildren, VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import type { Listener } from './hands.ts';
import './watched.css';

interface ComputedProps<T> {
  /** Begins the computation; the returned function ends it. */
  readonly hands: { readonly start: (listener: Listener<T>) => () => void };
  /** A sentence about what is computed. */
  readonly sentence: string;
  readonly onClose: () => void;
  readonly children: (answer: T) => ComponentChildren;
}

type State<T> =
  | { readonly kind: 'running'; readonly share: number }
  | { readonly kind: 'failed'; readonly sentence: string }
  | { readonly kind: 'there'; readonly answer: T };

/** Computes the part from when it is first drawn until it is removed from the page. */
export function Computed<T>({ hands, sentence, onClose, children }: ComputedProps<T>): VNode {
  const [state, setState] = useState<State<T>>({ kind: 'running', share: 0 });
  useEffect(
    () =>
      hands.start({
        progress: (share) => {
          setState({ kind: 'running', share });
        },
        done: (answer) => {
          setState({ kind: 'there', answer });
        },
        failed: (reason) => {
          setState({ kind: 'failed', sentence: reason });
        },
      }),
    [],
  );
  switch (state.kind) {
    case 'there':
      return <>{children(state.answer)}</>;
    case 'failed':
      return (
        <div role="alert">
          <p>{state.sentence}</p>
          <button type="button" onClick={onClose}>
            Close
          </button>
        </div>
      );
    case 'running':
      return (
        <div class="watched">
          <p role="status">{sentence}</p>
          <progress value={state.share} aria-label="Progress" />
          <div class="watched-row">
            <button type="button" onClick={onClose}>
              Cancel
            </button>
          </div>
        </div>
      );
  }
}

interface TransportProps {
  /** The word in the names of the buttons and the slider, such as `flow` or `simplification`. */
  readonly name: string;
  readonly last: number;
  readonly time: number;
  readonly isPlaying: boolean;
  /** The text of the slider's place, for screen readers. */
  readonly words: string;
  readonly rest: (time: number) => void;
  readonly toggle: () => void;
}

/** A button that plays, and a slider for the time. */
export function Transport({ name, last, time, isPlaying, words, rest, toggle }: TransportProps): VNode {
  return (
    <div class="watched-row">
      <button type="button" class="play" id={`play-${name}`} onClick={toggle} aria-label={isPlaying ? `Stop the ${name} here` : `Play the ${name}`}>
        {isPlaying ? 'Pause' : 'Play'}
      </button>
      <input
        type="range"
        name={name}
        min={0}
        max={last}
        value={Math.round(time)}
        aria-label={`Step of the ${name}`}
        aria-valuetext={words}
        onInput={(event) => {
          rest(Number(event.currentTarget.value));
        }}
      />
    </div>
  );
}
