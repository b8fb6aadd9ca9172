/** The falling energy of a run as a small curve, a piece for each relaxation. */
import { make } from '../dom.ts';

const NAMESPACE = 'http://www.w3.org/2000/svg';
const WIDTH = 240;
const HEIGHT = 44;
const MARGIN = 2;

/** The pieces' corners, one piece right of the other: the first energy left, the least of all at the bottom. */
function corners(pieces: readonly (readonly number[])[]): (readonly [number, number])[][] {
  const all = pieces.flat();
  const least = Math.min(...all);
  const range = Math.max(...all) - least || 1;
  let index = 0;
  return pieces.map((energies) =>
    energies.map((energy) => {
      const x = MARGIN + ((WIDTH - 2 * MARGIN) * index++) / Math.max(1, all.length - 1);
      const y = MARGIN + (HEIGHT - 2 * MARGIN) * (1 - (energy - least) / range);
      return [x, y] as const;
    }),
  );
}

function shape(name: string, attributes: Readonly<Record<string, string>>): SVGElement {
  const element: SVGElement = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  return element;
}

/** A faint upright line between two pieces, whose energies do not compare. */
function border(before: readonly [number, number], after: readonly [number, number]): SVGElement {
  const x = ((before[0] + after[0]) / 2).toFixed(1);
  return shape('line', { x1: x, x2: x, y1: '0', y2: String(HEIGHT) });
}

/** The curve; hidden while it has less than two points. */
export class EnergyCurve {
  readonly root: HTMLElement;
  readonly #picture: SVGElement;
  #drawn: readonly (readonly number[])[] = [];

  constructor() {
    this.#picture = shape('svg', {
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      preserveAspectRatio: 'none',
      'aria-hidden': 'true',
    });
    this.root = make('div', { class: 'energy-curve', hidden: true }, this.#picture);
  }

  /** Draws the energies of each relaxation, the first first. */
  show(energies: readonly (readonly number[])[]): void {
    if (this.#drawn === energies) {
      return;
    }
    this.#drawn = energies;
    const pieces = energies.filter((piece) => piece.length > 0);
    this.root.hidden = pieces.flat().length < 2;
    const drawn: SVGElement[] = [];
    let before: readonly [number, number] | undefined;
    for (const piece of corners(pieces)) {
      const [first] = piece;
      if (before !== undefined && first !== undefined) {
        drawn.push(border(before, first));
      }
      // A piece of one point is drawn as a dot.
      const points = (piece.length === 1 ? [...piece, ...piece] : piece).map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`);
      drawn.push(shape('polyline', { points: points.join(' ') }));
      before = piece.at(-1);
    }
    this.#picture.replaceChildren(...drawn);
  }
}
