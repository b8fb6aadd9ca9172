/** The falling energy of a run as a small curve. */
import { make } from './dom.ts';

const NAMESPACE = 'http://www.w3.org/2000/svg';
const WIDTH = 240;
const HEIGHT = 44;
const MARGIN = 2;

/** The corners of the curve: the first energy left, the least at the bottom. */
function corners(energies: readonly number[]): string {
  const least = Math.min(...energies);
  const range = Math.max(...energies) - least || 1;
  return energies
    .map((energy, index) => {
      const x = MARGIN + ((WIDTH - 2 * MARGIN) * index) / Math.max(1, energies.length - 1);
      const y = MARGIN + (HEIGHT - 2 * MARGIN) * (1 - (energy - least) / range);
      return `${x.toFixed(1)},${y.toFixed(1)}`;
    })
    .join(' ');
}

/** The curve; hidden while it has less than two points. */
export class EnergyCurve {
  readonly root: HTMLElement;
  readonly #line = document.createElementNS(NAMESPACE, 'polyline');
  #drawn: readonly number[] = [];

  constructor() {
    const picture = document.createElementNS(NAMESPACE, 'svg');
    picture.setAttribute('viewBox', `0 0 ${WIDTH} ${HEIGHT}`);
    picture.setAttribute('preserveAspectRatio', 'none');
    picture.setAttribute('aria-hidden', 'true');
    picture.append(this.#line);
    this.root = make('div', { class: 'energy-curve', hidden: true }, picture);
  }

  /** Draws the energies, the first first. */
  show(energies: readonly number[]): void {
    if (this.#drawn === energies) {
      return;
    }
    this.#drawn = energies;
    this.root.hidden = energies.length < 2;
    if (energies.length >= 2) {
      this.#line.setAttribute('points', corners(energies));
    }
  }
}
