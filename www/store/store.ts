/** Holds the state and tells its listeners of every change. It is the only thing on the page that holds it. */
import { change } from './change.ts';
import type { Event } from './events.ts';
import type { State } from './state.ts';
import { INITIAL } from './state.ts';

/** Hears of a change. */
export type Listener = (state: State, previous: State) => void;

/** An event with what it lacks and others know. */
export type Complete = (state: State, event: Event) => Event;

export class Store {
  #state = INITIAL;
  #complete: Complete = (_, event) => event;
  #listeners: readonly Listener[] = [];

  get state(): State {
    return this.#state;
  }

  /** From now on the listener hears of every change, after those that came before it, until the returned function is called. */
  subscribe(listener: Listener): () => void {
    this.#listeners = [...this.#listeners, listener];
    return () => {
      this.#listeners = this.#listeners.filter((other) => other !== listener);
    };
  }

  /** From now on every event comes with what this adds to it. */
  completeBy(complete: Complete): void {
    this.#complete = complete;
  }

  /** Changes the state; events that come together are one change and one step. */
  readonly dispatch = (...events: readonly Event[]): void => {
    const previous = this.#state;
    this.#state = change(
      previous,
      events.map((event) => this.#complete(previous, event)),
    );
    if (this.#state === previous) {
      return;
    }
    for (const listener of this.#listeners) {
      listener(this.#state, previous);
    }
  };
}
