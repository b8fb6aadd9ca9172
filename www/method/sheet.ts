/** One mesh in the plane with everything that is drawn on it: the cut, the patch lines, the patches and the cones. */
import type { BaseOutput } from '../compute/messages.ts';
import type { Side } from '../landmarks.ts';
import type { BasePart } from './parts.ts';

/** A mapped mesh as the core returns it. */
export interface MappedMesh {
  readonly triangles: Uint32Array;
  readonly positions: Float32Array;
  /** The face of the checked mesh that contains each triangle. */
  readonly checkedFaces: Uint32Array;
  /** The vertex of each landmark. */
  readonly landmarks: Uint32Array;
  /** The radius of each vertex's circle, in units of the plane. */
  readonly radii: Float32Array;
}

/** The layout of the mesh as the core returns it. */
export interface Growth {
  readonly points: Float32Array;
  readonly vertices: Uint32Array;
  readonly corners: Uint32Array;
  readonly order: Uint32Array;
  readonly rings: Uint32Array;
  readonly cut: Uint8Array;
  readonly turnedOver: number;
}

/** A segment of the plane. */
export interface Segment {
  readonly from: Spot;
  readonly to: Spot;
  /** The number of placed triangles from which on the segment is drawn. */
  readonly when: number;
}

export interface BorderSegment extends Segment {
  /** The number of the patch line. */
  readonly side: number;
}

/** A place of a landmark's cone; a cone on the cut has several places. */
export interface ConeSpot {
  readonly cone: number;
  readonly at: Spot;
  readonly when: number;
}

/** A place of the plane; y points up. */
export interface Spot {
  readonly x: number;
  readonly y: number;
}

/** A part of a patch in the plane, as a triangle. */
export interface PatchPart {
  readonly corners: readonly [Spot, Spot, Spot];
  readonly when: number;
}

type Weights = readonly [number, number, number];

/** For each key a list of numbers; the lists lie one after the other in `items`. */
interface Runs {
  readonly starts: Uint32Array;
  readonly items: Uint32Array;
}

/** The indices at which each key stands. */
function runsOf(keys: Uint32Array): Runs {
  const starts = new Uint32Array(keys.reduce((most, key) => Math.max(most, key), 0) + 2);
  keys.forEach((key) => {
    starts[key + 1] = (starts[key + 1] ?? 0) + 1;
  });
  for (let k = 1; k < starts.length; k += 1) {
    starts[k] = (starts[k] ?? 0) + (starts[k - 1] ?? 0);
  }
  const next = starts.slice();
  const items = new Uint32Array(keys.length);
  keys.forEach((key, item) => {
    const at = next[key] ?? 0;
    items[at] = item;
    next[key] = at + 1;
  });
  return { starts, items };
}

function run({ starts, items }: Runs, key: number): Uint32Array {
  return items.subarray(starts[key] ?? 0, starts[key + 1] ?? 0);
}

/** The distance of a place from a segment. */
function distanceTo({ from, to }: Segment, { x, y }: Spot): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = dx * dx + dy * dy;
  const share = length > 0 ? Math.min(1, Math.max(0, ((x - from.x) * dx + (y - from.y) * dy) / length)) : 0;
  return Math.hypot(x - from.x - share * dx, y - from.y - share * dy);
}

function holds([a, b, c]: readonly [Spot, Spot, Spot], { x, y }: Spot): boolean {
  const turn = (p: Spot, q: Spot): number => Math.sign((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x));
  const turns = [turn(a, b), turn(b, c), turn(c, a)];
  return !(turns.includes(1) && turns.includes(-1));
}

const NOWHERE: Spot = { x: 0, y: 0 };

/** A mesh in the plane. */
export class Sheet {
  readonly mesh: MappedMesh;
  readonly growth: Growth;
  /** For each triangle, the number of triangles that are placed once it is. */
  readonly when: Uint32Array;
  /** For each point of the layout, the number of triangles that are placed once the point is. */
  readonly pointWhen: Uint32Array;
  readonly cuts: readonly Segment[];
  readonly borders: readonly BorderSegment[];
  readonly cones: readonly ConeSpot[];
  readonly box: readonly [number, number, number, number];
  readonly #base: BaseOutput | null;
  readonly #side: Side;
  /** The triangles in each face of the checked mesh, and the parts of patches in each of these faces. */
  readonly #children: Runs;
  readonly #parts: Runs;

  constructor(mesh: MappedMesh, growth: Growth, base: BaseOutput | null, side: Side, seed: number) {
    this.mesh = mesh;
    this.growth = { ...growth, points: growth.points.slice() };
    this.#base = base;
    this.#side = side;
    this.#children = runsOf(mesh.checkedFaces);
    this.#parts = runsOf(base?.shapes[side].patchFaces ?? new Uint32Array());
    this.when = new Uint32Array(growth.order.length);
    growth.order.forEach((face, k) => {
      this.when[face] = k + 1;
    });
    this.pointWhen = new Uint32Array(growth.vertices.length).fill(growth.order.length + 1);
    growth.corners.forEach((point, corner) => {
      this.pointWhen[point] = Math.min(this.pointWhen[point] ?? 0, this.when[Math.floor(corner / 3)] ?? 0);
    });
    this.#turn(seed);
    this.box = this.#bounds();
    this.cuts = this.#cuts();
    this.borders = this.#borders(() => true);
    this.cones = this.#cones();
  }

  /** The place of a point of the layout. */
  spot(point: number): Spot {
    return { x: this.growth.points[2 * point] ?? 0, y: this.growth.points[2 * point + 1] ?? 0 };
  }

  /** The corners of a triangle. */
  corners(face: number): readonly [Spot, Spot, Spot] {
    const { corners } = this.growth;
    return [this.spot(corners[3 * face] ?? 0), this.spot(corners[3 * face + 1] ?? 0), this.spot(corners[3 * face + 2] ?? 0)];
  }

  /** A patch, by its base triangle. */
  patch(index: number): readonly PatchPart[] {
    const { patchStarts } = this.#base?.shapes[this.#side] ?? {};
    const begin = patchStarts?.[index] ?? 0;
    return Array.from({ length: (patchStarts?.[index + 1] ?? 0) - begin }, (_, k) => this.#part(begin + k));
  }

  /** The part of the base domain near a place; `null` where none is near. */
  partAt(at: Spot, reach: number, shown: number): BasePart | null {
    const cone = this.cones.find((each) => each.when <= shown && Math.hypot(each.at.x - at.x, each.at.y - at.y) <= 1.6 * reach);
    if (cone !== undefined) {
      return { kind: 'cone', index: cone.cone };
    }
    const border = this.borders.find((each) => each.when <= shown && distanceTo(each, at) <= reach);
    if (border !== undefined) {
      return { kind: 'side', index: border.side };
    }
    return this.#patchAt(at, shown);
  }

  #patchAt(at: Spot, shown: number): BasePart | null {
    const { order } = this.growth;
    for (let k = Math.min(shown, order.length) - 1; k >= 0; k -= 1) {
      const face = order[k] ?? 0;
      if (holds(this.corners(face), at)) {
        const parts = [...run(this.#parts, this.mesh.checkedFaces[face] ?? 0)];
        const part = parts.find((each) => holds(this.#part(each).corners, at)) ?? parts[0];
        const starts = this.#base?.shapes[this.#side].patchStarts ?? new Uint32Array();
        const patch = part === undefined ? -1 : starts.findIndex((start) => start > part) - 1;
        return patch < 0 ? null : { kind: 'face', index: patch };
      }
    }
    return null;
  }

  /** Turns the plane so that the first side of the seed's patch points to the right, and both meshes lie alike. */
  #turn(seed: number): void {
    const first = this.#borders((corner) => corner === 3 * seed);
    const [x, y] = first.reduce<readonly [number, number]>(([sx, sy], { from, to }) => [sx + to.x - from.x, sy + to.y - from.y], [0, 0]);
    const length = Math.hypot(x, y);
    const [c, s] = length > 0 ? [x / length, -y / length] : [1, 0];
    const { points } = this.growth;
    for (let k = 0; k < points.length; k += 2) {
      const [px, py] = [points[k] ?? 0, points[k + 1] ?? 0];
      points[k] = c * px - s * py;
      points[k + 1] = s * px + c * py;
    }
  }

  #bounds(): readonly [number, number, number, number] {
    const { points } = this.growth;
    const box: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let k = 0; k < points.length; k += 2) {
      const [x, y] = [points[k] ?? 0, points[k + 1] ?? 0];
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    }
    return box;
  }

  /** The edges of the cut; each is drawn once both its triangles are placed. */
  #cuts(): readonly Segment[] {
    const { cut, corners } = this.growth;
    const { triangles, landmarks } = this.mesh;
    const count = this.mesh.positions.length / 3 + landmarks.length;
    const halfedges = [...cut.keys()].filter((corner) => cut[corner] === 1);
    const next = (corner: number): number => (corner % 3 === 2 ? corner - 2 : corner + 1);
    const key = (corner: number): number => {
      const [a, b] = [triangles[corner] ?? 0, triangles[next(corner)] ?? 0];
      return Math.min(a, b) * count + Math.max(a, b);
    };
    const whens = new Map<number, number>();
    for (const corner of halfedges) {
      const own = this.when[Math.floor(corner / 3)] ?? 0;
      whens.set(key(corner), Math.max(own, whens.get(key(corner)) ?? 0));
    }
    return halfedges.map((corner) => ({
      from: this.spot(corners[corner] ?? 0),
      to: this.spot(corners[next(corner)] ?? 0),
      when: whens.get(key(corner)) ?? 0,
    }));
  }

  /** The pieces of the patch lines that begin at the wanted corners of base triangles. */
  #borders(wanted: (corner: number) => boolean): readonly BorderSegment[] {
    const base = this.#base;
    if (base === null) {
      return [];
    }
    const { patchBorders } = base.shapes[this.#side];
    const found: BorderSegment[] = [];
    for (let k = 0; k < patchBorders.length; k += 4) {
      const [corner = 0, face = 0, a = 0, b = 0] = patchBorders.subarray(k, k + 4);
      if (wanted(corner)) {
        const { spots, when } = this.#placed(face, [a, b]);
        found.push({ from: spots[0] ?? NOWHERE, to: spots[1] ?? NOWHERE, when, side: base.sides[corner] ?? 0 });
      }
    }
    return found;
  }

  #cones(): readonly ConeSpot[] {
    const cones = new Map([...this.mesh.landmarks].map((vertex, cone) => [vertex, cone]));
    return [...this.growth.vertices].flatMap((vertex, point) => {
      const cone = cones.get(vertex);
      return cone === undefined ? [] : [{ cone, at: this.spot(point), when: this.pointWhen[point] ?? 0 }];
    });
  }

  #part(part: number): PatchPart {
    const { patchTriangles, patchFaces } = this.#base?.shapes[this.#side] ?? {};
    const points = [0, 1, 2].map((k) => patchTriangles?.[3 * part + k] ?? 0);
    const { spots, when } = this.#placed(patchFaces?.[part] ?? 0, points);
    return { corners: [spots[0] ?? NOWHERE, spots[1] ?? NOWHERE, spots[2] ?? NOWHERE], when };
  }

  /** The places in the plane of points that lie in one face of the checked mesh; all are placed by the triangle that holds their middle. */
  #placed(face: number, points: readonly number[]): { readonly spots: readonly Spot[]; readonly when: number } {
    const places = points.map((point) => this.#placeOf(point));
    const middle = [0, 1, 2].map((k) => places.reduce((sum, place) => sum + (place[k] ?? 0), 0) / places.length);
    let [best, most] = [-1, -Infinity];
    for (const child of run(this.#children, face)) {
      const least = Math.min(...this.#weights(child, middle));
      if (least > most) {
        [best, most] = [child, least];
      }
    }
    if (best < 0) {
      return { spots: points.map(() => NOWHERE), when: Infinity };
    }
    const [p, q, r] = this.corners(best);
    const spots = places.map((place) => {
      const [u, v, w] = this.#weights(best, place);
      return { x: u * p.x + v * q.x + w * r.x, y: u * p.y + v * q.y + w * r.y };
    });
    return { spots, when: this.when[best] ?? 0 };
  }

  #placeOf(point: number): readonly number[] {
    return [...(this.#base?.shapes[this.#side].patchPoints.subarray(3 * point, 3 * point + 3) ?? [])];
  }

  /** The barycentric coordinates, in a triangle in space, of the point of its plane that is nearest to a place. */
  #weights(face: number, place: readonly number[]): Weights {
    const corner = (k: number): readonly number[] => {
      const v = this.mesh.triangles[3 * face + k] ?? 0;
      return [...this.mesh.positions.subarray(3 * v, 3 * v + 3)];
    };
    const dot = (a: readonly number[], b: readonly number[]): number => a.reduce((sum, x, k) => sum + x * (b[k] ?? 0), 0);
    const from = corner(0);
    const minus = (a: readonly number[]): readonly number[] => a.map((x, k) => x - (from[k] ?? 0));
    const [e, f, d] = [minus(corner(1)), minus(corner(2)), minus(place)];
    const [ee, ef, ff, de, df] = [dot(e, e), dot(e, f), dot(f, f), dot(d, e), dot(d, f)];
    const volume = ee * ff - ef * ef;
    if (!(volume > 0)) {
      return [1, 0, 0];
    }
    const [v, w] = [(ff * de - ef * df) / volume, (ee * df - ef * de) / volume];
    return [1 - v - w, v, w];
  }
}
