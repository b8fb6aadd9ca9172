/** A time, counted in steps, that plays to its end. */
import { useEffect, useRef, useState } from 'preact/hooks';

export interface Played {
  /** The time in steps; it lies between two steps only while it plays, and only where the user does not ask for less motion. */
  readonly time: number;
  readonly isPlaying: boolean;
  /** Stops at a time. */
  readonly rest: (time: number) => void;
  /** Plays on, from the beginning where it is at its end, or stops. */
  readonly toggle: () => void;
  /** Plays from the beginning. */
  readonly restart: () => void;
}

/** A time from 0 to the last step; each step takes `stepTime` ms. */
export function usePlayed(last: number, stepTime: number): Played {
  const [time, setTime] = useState(0);
  const [isPlaying, setPlaying] = useState(false);
  const [round, setRound] = useState(0);
  const from = useRef(0);
  useEffect(() => {
    if (!isPlaying) {
      return undefined;
    }
    const still = window.matchMedia('(prefers-reduced-motion: reduce)');
    let begin: number | null = null;
    const tick = (now: number): void => {
      begin ??= now;
      const next = Math.min(last, from.current + (now - begin) / stepTime);
      setTime(still.matches ? Math.floor(next) : next);
      if (next < last) {
        frame = requestAnimationFrame(tick);
      } else {
        setPlaying(false);
      }
    };
    let frame = requestAnimationFrame(tick);
    return () => {
      cancelAnimationFrame(frame);
    };
  }, [isPlaying, last, round]);
  return {
    time,
    isPlaying,
    rest: (at) => {
      setPlaying(false);
      setTime(at);
    },
    toggle: () => {
      from.current = time >= last ? 0 : time;
      setPlaying(!isPlaying);
    },
    restart: () => {
      from.current = 0;
      setTime(0);
      setRound(round + 1);
      setPlaying(true);
    },
  };
}
