/** The falling energy of a run as a small curve, with a piece for each relaxation. */
import type { VNode } from 'preact';
import { memo } from './memo.ts';

const WIDTH = 240;
const HEIGHT = 64;
const MARGIN = 2;

type Corner = readonly [number, number];

/**
 * The corners of the pieces, one piece to the right of the other: the first energy is on the left, the least of all energies at the bottom.
 */
function corners(pieces: readonly (readonly number[])[]): readonly (readonly Corner[])[] {
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

function Piece({ piece }: { readonly piece: readonly Corner[] }): VNode {
  // A piece of one energy is drawn as a dot.
  const points = piece.length === 1 ? [...piece, ...piece] : piece;
  return <polyline points={points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ')} />;
}

/** A faint vertical line between two pieces, whose energies cannot be compared. */
function Border({ before, after }: { readonly before: Corner | undefined; readonly after: Corner | undefined }): VNode | null {
  if (before === undefined || after === undefined) {
    return null;
  }
  const x = ((before[0] + after[0]) / 2).toFixed(1);
  return <line x1={x} x2={x} y1="0" y2={HEIGHT} />;
}

function Curve({ energies }: { readonly energies: readonly (readonly number[])[] }): VNode {
  const pieces = corners(energies.filter((piece) => piece.length > 0));
  return (
    <div class="energy-curve" hidden={pieces.flat().length < 2}>
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} preserveAspectRatio="none" aria-hidden="true">
        {pieces.map((piece, index) => (
          <Piece key={index} piece={piece} />
        ))}
        {pieces.slice(1).map((piece, index) => (
          <Border key={index} before={pieces[index]?.at(-1)} after={piece[0]} />
        ))}
      </svg>
    </div>
  );
}

/** The curve; it is hidden while it has fewer than two points. */
export const EnergyCurve = memo(Curve);
