/** The rings of suggested points over a view; a click or a key takes one as a landmark. */
import { make } from '../dom.ts';
import type { Suggestion, Taking } from '../landmarks.ts';
import { suggestionName } from '../messages.ts';

/** The rings over one view. */
export class Rings {
  readonly #layer: HTMLElement;
  #rings: HTMLButtonElement[] = [];

  constructor(view: HTMLElement, side: string) {
    this.#layer = make('div', { class: 'rings', role: 'group', 'aria-label': `Suggested points of the ${side}` });
    view.append(this.#layer);
  }

  /** Shows these suggestions; `take` is called with the one that is taken. */
  show(suggestions: readonly Suggestion[], taking: Taking, take: (suggestion: Suggestion) => void): void {
    this.#rings = suggestions.map((suggestion) => {
      const name = suggestionName(suggestion, suggestions, taking);
      const ring = make('button', { type: 'button', title: name, 'aria-label': `Take ${name}` }, suggestion.letter);
      ring.addEventListener('click', () => {
        take(suggestion);
      });
      ring.addEventListener('keydown', (event) => {
        if (event.key === 'Enter' || event.key === ' ') {
          // Otherwise the view below would pick the point in its middle.
          event.stopPropagation();
        }
      });
      return ring;
    });
    this.#layer.replaceChildren(...this.#rings);
  }

  /** Places the rings; `places` has x and y in [-1, 1] (y up) and visible (0 or 1) for each. */
  place(places: Float32Array, width: number, height: number): void {
    this.#rings.forEach((ring, index) => {
      ring.hidden = (places[3 * index + 2] ?? 0) < 0.5;
      if (!ring.hidden) {
        const x = (((places[3 * index] ?? 0) + 1) / 2) * width;
        const y = ((1 - (places[3 * index + 1] ?? 0)) / 2) * height;
        ring.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
      }
    });
  }
}
