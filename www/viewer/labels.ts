/** The landmarks' numbers over a view. */
import { make } from '../dom.ts';

/** One view's numbers. */
export class Labels {
  readonly #layer = make('div', { class: 'labels', 'aria-hidden': 'true' });
  readonly #items: HTMLElement[] = [];

  constructor(view: HTMLElement) {
    view.prepend(this.#layer);
  }

  /** Places the numbers: x, y in [-1, 1] (y up) and visible (0 or 1) for each landmark. */
  place(places: Float32Array, width: number, height: number): void {
    const count = Math.floor(places.length / 3);
    while (this.#items.length < count) {
      const item = make('span', {}, String(this.#items.length + 1));
      this.#layer.append(item);
      this.#items.push(item);
    }
    this.#items.forEach((item, index) => {
      const visible = index < count && (places[3 * index + 2] ?? 0) > 0.5;
      item.hidden = !visible;
      if (visible) {
        const x = (((places[3 * index] ?? 0) + 1) / 2) * width;
        const y = ((1 - (places[3 * index + 1] ?? 0)) / 2) * height;
        item.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      }
    });
  }
}
