/** What every panel is. */
import type { Side } from '../landmarks.ts';
import type { Event } from '../store/events.ts';
import type { Doubt, State } from '../store/state.ts';

/** Shows a part of the state; `previous` is `null` the first time. */
export interface Panel {
  render(state: State, previous: State | null): void;
}

/** What panels ask for beyond a change of state. */
export interface Actions {
  readonly dispatch: (event: Event) => void;
  readonly openFiles: (files: readonly File[], side: Side | null) => void;
  readonly openDemo: (id: string) => void;
  readonly run: () => void;
  /** Looks for places of one mesh that are worth a landmark. */
  readonly suggest: (side: Side) => void;
  /** Asks the run for its result. */
  readonly finish: () => void;
  readonly cancel: () => void;
  readonly repair: (finding: Doubt) => void;
}
