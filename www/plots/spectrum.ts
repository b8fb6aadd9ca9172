/** Measures the pieces of a map and sums the source's area by how much it is distorted, in fine classes. */
import type { Pieces } from '../store/state.ts';

/** The measures of a piece, see {@link measure}. */
export const MEASURES = ['density', 'angle', 'area'] as const;
export type Measure = (typeof MEASURES)[number];

/** The number of fine classes in a power of ten. */
export const CLASSES_PER_DECADE = 1000;
/** The number of powers of ten that the classes cover above 1, and below 1 where a measure can be below 1. */
const DECADES = 4;

/** Shares of the area, by classes of the logarithm of a measure. */
export interface Spectrum {
  /** The logarithm to base 10 of the first class's lower end. */
  readonly first: number;
  /** The share of the area in each class; values beyond the last class are counted in it. */
  readonly shares: Float64Array;
  readonly mean: number;
}

export type Spectra = Readonly<Record<Measure, Spectrum>>;

/** The measures of the linear map from one triangle to another, with the singular values s1 and s2. */
export interface PieceMeasures {
  /** (s1² + s2² + s1⁻² + s2⁻²) / 4; 1 for an isometry. */
  readonly density: number;
  /** (s1/s2 + s2/s1) / 2; 1 where angles stay. */
  readonly angle: number;
  /** s1 s2; 1 where the area stays. */
  readonly area: number;
}

/** A triangle in its own plane: its corners are (0, 0), (length, 0) and (along, height). */
interface Flat {
  readonly length: number;
  readonly along: number;
  readonly height: number;
}

/** The length of a vector; quicker than `Math.hypot`, which also handles numbers that no mesh has. */
function norm(x: number, y: number, z: number): number {
  return Math.sqrt(x * x + y * y + z * z);
}

function flat(places: Float32Array, a: number, b: number, c: number): Flat {
  const p = (corner: number, axis: number): number => places[3 * corner + axis] ?? NaN;
  const [ux, uy, uz] = [p(b, 0) - p(a, 0), p(b, 1) - p(a, 1), p(b, 2) - p(a, 2)];
  const [vx, vy, vz] = [p(c, 0) - p(a, 0), p(c, 1) - p(a, 1), p(c, 2) - p(a, 2)];
  const length = norm(ux, uy, uz);
  const doubleArea = norm(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx);
  return { length, along: (ux * vx + uy * vy + uz * vz) / length, height: doubleArea / length };
}

/** The measures of the linear map from one triangle to another, both in units of their meshes' sizes; both must have an area. */
export function measure(from: Flat, to: Flat): PieceMeasures {
  // The matrix takes (length, 0) to (length, 0) and (along, height) to (along, height) of the other: it is upper triangular.
  const [a, d] = [to.length / from.length, to.height / from.height];
  const b = (to.along - a * from.along) / from.height;
  const [squares, area] = [a * a + b * b + d * d, a * d];
  return { density: (squares + squares / (area * area)) / 4, angle: squares / (2 * area), area };
}

/** The least share of the mesh's area that a measured piece has: single precision cannot give the shape of smaller ones. */
const LEAST_SHARE = 1e-10;

/** Sums up one measure over the pieces. */
class Sum {
  readonly #first: number;
  readonly #shares: Float64Array;
  #mean = 0;
  #weight = 0;

  constructor(first: number) {
    this.#first = first;
    this.#shares = new Float64Array((DECADES - first) * CLASSES_PER_DECADE);
  }

  add(value: number, weight: number): void {
    const index = Math.floor((Math.log10(value) - this.#first) * CLASSES_PER_DECADE);
    const kept = Math.min(this.#shares.length - 1, Math.max(0, index));
    this.#shares[kept] = (this.#shares[kept] ?? 0) + weight;
    this.#mean += weight * value;
    this.#weight += weight;
  }

  get spectrum(): Spectrum {
    const weight = this.#weight;
    return { first: this.#first, shares: this.#shares.map((share) => share / weight), mean: this.#mean / weight };
  }
}

function totalArea(places: Float32Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let k = 0; k < triangles.length; k += 3) {
    const { length, height } = flat(places, triangles[k] ?? 0, triangles[k + 1] ?? 0, triangles[k + 2] ?? 0);
    sum += length > 0 ? (length * height) / 2 : 0;
  }
  return sum;
}

function scaled({ length, along, height }: Flat, factor: number): Flat {
  return { length: length * factor, along: along * factor, height: height * factor };
}

/** A piece with its share of the source's area. */
interface MeasuredPiece {
  readonly share: number;
  readonly measures: PieceMeasures;
}

/** The factors that scale both meshes to area 1. */
function factorsOf({ triangles, places }: Pieces): readonly [number, number] {
  const factor = (points: Float32Array): number => 1 / Math.sqrt(totalArea(points, triangles));
  return [factor(places[0]), factor(places[1])];
}

/** The piece whose first corner has this index; `null` where its area is too small to be measured. */
function measuredPiece({ triangles, places }: Pieces, factors: readonly [number, number], first: number): MeasuredPiece | null {
  const corners = [triangles[first] ?? 0, triangles[first + 1] ?? 0, triangles[first + 2] ?? 0] as const;
  const from = scaled(flat(places[0], ...corners), factors[0]);
  const to = scaled(flat(places[1], ...corners), factors[1]);
  const share = (from.length * from.height) / 2;
  return share > LEAST_SHARE && to.length * to.height > 2 * LEAST_SHARE ? { share, measures: measure(from, to) } : null;
}

/** Calls `each` with every piece and the index of its first corner, both meshes scaled to area 1. */
export function measurePieces(pieces: Pieces, each: (first: number, piece: MeasuredPiece) => void): void {
  const factors = factorsOf(pieces);
  for (let first = 0; first < pieces.triangles.length; first += 3) {
    const piece = measuredPiece(pieces, factors, first);
    if (piece !== null) {
      each(first, piece);
    }
  }
}

/** The number of pieces that are measured in one turn: some milliseconds of work. */
const AT_A_TIME = 30_000;

/** Measures all pieces, both meshes scaled to area 1. It awaits `pause` again and again, so that the page can draw meanwhile. */
export async function spectraOf(pieces: Pieces, pause: () => Promise<void>): Promise<Spectra> {
  const factors = factorsOf(pieces);
  await pause();
  const sums = { density: new Sum(0), angle: new Sum(0), area: new Sum(-DECADES) };
  for (let k = 0; k < pieces.triangles.length; k += 3) {
    const piece = measuredPiece(pieces, factors, k);
    if (piece !== null) {
      for (const name of MEASURES) {
        sums[name].add(piece.measures[name], piece.share);
      }
    }
    if (k % (3 * AT_A_TIME) === 0) {
      await pause();
    }
  }
  return { density: sums.density.spectrum, angle: sums.angle.spectrum, area: sums.area.spectrum };
}

/** The value below which this share of the area stays, up to the width of a class. */
export function quantile({ first, shares }: Spectrum, share: number): number {
  let sum = 0;
  const index = shares.findIndex((part) => (sum += part) >= share);
  return 10 ** (first + ((index < 0 ? shares.length : index) + 0.5) / CLASSES_PER_DECADE);
}
