/** The numbers of the landmarks over a view. */
import { make } from '../dom.ts';

/** A number, and whether it stands out. */
export interface Label {
  readonly text: string;
  readonly raised: boolean;
}

/** The distance from the middle of a pin's head to its number, in CSS pixels: a little more than the head's radius. */
const BESIDE = { plain: 8, raised: 10 };

/** The numbers over one view. */
export class Labels {
  readonly #layer = make('div', { class: 'labels', 'aria-hidden': 'true' });
  readonly #items: HTMLElement[] = [];

  constructor(view: HTMLElement) {
    view.prepend(this.#layer);
  }

  /** Places the numbers beside the heads of their pins; `places` has x and y in [-1, 1] (y up) and visible (0 or 1) for each. */
  place(labels: readonly Label[], places: Float32Array, width: number, height: number): void {
    while (this.#items.length < labels.length) {
      const item = make('span');
      item.style.inset = '0 auto auto 0';
      this.#layer.append(item);
      this.#items.push(item);
    }
    this.#items.forEach((item, index) => {
      const label = labels[index];
      const visible = label !== undefined && (places[3 * index + 2] ?? 0) > 0.5;
      item.hidden = !visible;
      item.classList.toggle('raised', visible && label.raised);
      if (visible) {
        if (item.textContent !== label.text) {
          item.textContent = label.text;
        }
        const x = (((places[3 * index] ?? 0) + 1) / 2) * width + (label.raised ? BESIDE.raised : BESIDE.plain);
        const y = ((1 - (places[3 * index + 1] ?? 0)) / 2) * height;
        item.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translateY(-50%)`;
      }
    });
  }
}
