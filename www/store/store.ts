/** Holds the state, and calls its listeners at every change. Nothing else on the page holds the state. */
import { change } from './change.ts';
import type { Event } from './events.ts';
import type { State } from './state.ts';
import { INITIAL } from './state.ts';

/** A listener to changes of the state. */
export type Listener = (state: State, previous: State) => void;

/** Completes an event with fields that only others know. */
export type Complete = (state: State, event: Event) => Event;

export class Store {
  #state = INITIAL;
  #complete: Complete = (_, event) => event;
  #listeners: readonly Listener[] = [];

  get state(): State {
    return this.#state;
  }

  /** Calls the listener at every change from now on, after the listeners that came before it, until the returned function is called. */
  subscribe(listener: Listener): () => void {
    this.#listeners = [...this.#listeners, listener];
    return () => {
      this.#listeners = this.#listeners.filter((other) => other !== listener);
    };
  }

  /** Completes every event by this function from now on. */
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
