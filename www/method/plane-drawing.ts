/** Draws a mesh in the plane, in a worker: as pixels, as SVG, and as an OBJ file. */
import { ACCENT, CUT, PAPER } from '../colours.ts';
import { escaped } from '../svg.ts';
import type { Palette } from './drawing.ts';
import { DARK, LIGHT, mixed } from './drawing.ts';
import type { BasePart } from './parts.ts';
import { ballRadius } from './picture.ts';
import type { PlaneFrame } from './plane-messages.ts';
import type { Segment, Sheet, Spot } from './sheet.ts';

/** The share of full light with which all triangles of the plane are drawn. */
const LIGHTNESS = 0.85;
/** The radius below which a circle is not drawn, in pixels. */
const LEAST_CIRCLE = 0.35;
/** Edges are drawn where the mean size of a triangle is more than this, in pixels. */
const EDGES_FROM = 5;
/** The margin of a picture that shows the whole, in pixels. */
const MARGIN = 14;

/** The middle and the scale at which the whole fits into a picture. */
export function fitted([left, low, right, high]: Sheet['box'], { width, height }: { readonly width: number; readonly height: number }, density = 1): Pick<PlaneFrame, 'x' | 'y' | 'scale'> {
  const room = (size: number): number => Math.max(1, size - 2 * MARGIN * density);
  const scale = Math.min(room(width) / Math.max(right - left, 1e-9), room(height) / Math.max(high - low, 1e-9));
  return { x: (left + right) / 2, y: (low + high) / 2, scale };
}

type Placing = Pick<PlaneFrame, 'width' | 'height' | 'x' | 'y' | 'scale'>;

function across(frame: Placing, { x, y }: Spot): readonly [number, number] {
  return [frame.width / 2 + frame.scale * (x - frame.x), frame.height / 2 - frame.scale * (y - frame.y)];
}

type Context = OffscreenCanvasRenderingContext2D;

function addTriangle(context: Context, frame: Placing, corners: readonly [Spot, Spot, Spot]): void {
  const [a, b, c] = [across(frame, corners[0]), across(frame, corners[1]), across(frame, corners[2])];
  context.moveTo(a[0], a[1]);
  context.lineTo(b[0], b[1]);
  context.lineTo(c[0], c[1]);
  context.closePath();
}

function strokeSegments(context: Context, frame: Placing, segments: readonly Segment[]): void {
  context.beginPath();
  for (const { from, to } of segments) {
    const [a, b] = [across(frame, from), across(frame, to)];
    context.moveTo(a[0], a[1]);
    context.lineTo(b[0], b[1]);
  }
  context.stroke();
}

/** Draws one mesh. Triangles that were drawn stay drawn as long as the view does not change. */
export class PlanePainter {
  readonly #sheet: Sheet;
  readonly #curvatures: Float64Array;
  #ground: OffscreenCanvas | null = null;
  #key = '';
  #placed = 0;

  constructor(sheet: Sheet, curvatures: Float64Array) {
    this.#sheet = sheet;
    this.#curvatures = curvatures;
  }

  /** Draws a frame. */
  draw(frame: PlaneFrame): OffscreenCanvas {
    const canvas = new OffscreenCanvas(frame.width, frame.height);
    const context = canvas.getContext('2d');
    if (context !== null) {
      const palette = frame.look === 'dark' ? DARK : LIGHT;
      this.#lay(frame, palette);
      if (this.#ground !== null) {
        context.drawImage(this.#ground, 0, 0);
      }
      context.lineCap = 'round';
      context.lineJoin = 'round';
      this.#over(context, frame, palette);
    }
    return canvas;
  }

  /** Draws the triangles that have been added since the last frame. */
  #lay(frame: PlaneFrame, palette: Palette): void {
    const { width, height, x, y, scale, look, shown } = frame;
    const key = [width, height, x, y, scale, look].join(' ');
    if (this.#ground === null || key !== this.#key || shown < this.#placed) {
      this.#ground = new OffscreenCanvas(width, height);
      this.#key = key;
      this.#placed = 0;
    }
    const context = this.#ground.getContext('2d');
    if (context === null || shown === this.#placed) {
      return;
    }
    context.beginPath();
    for (const face of this.#sheet.growth.order.subarray(this.#placed, shown)) {
      addTriangle(context, frame, this.#sheet.corners(face));
    }
    const fill = mixed(palette.face, LIGHTNESS);
    context.fillStyle = fill;
    context.strokeStyle = fill;
    // A thin stroke in the triangles' own colour closes the seams between them.
    context.lineWidth = 0.6;
    context.fill();
    context.stroke();
    const pixels = scale / Math.sqrt(this.#sheet.when.length);
    if (pixels > EDGES_FROM) {
      context.strokeStyle = palette.side;
      context.globalAlpha = Math.min(0.5, (pixels - EDGES_FROM) / 20);
      context.stroke();
      context.globalAlpha = 1;
    }
    this.#placed = shown;
  }

  #over(context: Context, frame: PlaneFrame, palette: Palette): void {
    const { density, shown, lit, look } = frame;
    const sheet = this.#sheet;
    if (lit?.kind === 'face') {
      context.beginPath();
      sheet.patch(lit.index).filter(({ when }) => when <= shown).forEach(({ corners }) => {
        addTriangle(context, frame, corners);
      });
      context.fillStyle = mixed(palette.litFace, 0.7);
      context.fill();
    }
    if (frame.circles === 'shown') {
      this.#circles(context, frame);
    }
    const there = <S extends Segment>(segments: readonly S[]): readonly S[] => segments.filter(({ when }) => when <= shown);
    const borders = there(sheet.borders);
    context.strokeStyle = palette.ink;
    context.lineWidth = 1.1 * density;
    strokeSegments(context, frame, borders);
    context.strokeStyle = CUT[look];
    context.lineWidth = 2 * density;
    strokeSegments(context, frame, there(sheet.cuts));
    if (lit?.kind === 'side') {
      context.strokeStyle = palette.lit;
      context.lineWidth = 4 * density;
      strokeSegments(context, frame, borders.filter(({ side }) => side === lit.index));
    }
    this.#cones(context, frame, palette);
  }

  /** Draws the circles of the packing. */
  #circles(context: Context, frame: PlaneFrame): void {
    const { growth, mesh, pointWhen } = this.#sheet;
    context.beginPath();
    growth.vertices.forEach((vertex, point) => {
      const radius = frame.scale * (mesh.radii[vertex] ?? 0);
      if ((pointWhen[point] ?? 0) <= frame.shown && radius > LEAST_CIRCLE) {
        const [x, y] = across(frame, this.#sheet.spot(point));
        context.moveTo(x + radius, y);
        context.arc(x, y, radius, 0, 2 * Math.PI);
      }
    });
    context.strokeStyle = ACCENT[frame.look];
    // The strokes must not be much thicker than small circles are wide, or they would hide what is beneath.
    context.lineWidth = Math.min(frame.density, Math.max(0.3, (0.15 * frame.scale) / Math.sqrt(growth.vertices.length)));
    context.stroke();
  }

  #cones(context: Context, frame: PlaneFrame, palette: Palette): void {
    const { density, lit } = frame;
    for (const { cone, at, when } of this.#sheet.cones) {
      if (when <= frame.shown) {
        const curvature = this.#curvatures[cone] ?? 0;
        const [x, y] = across(frame, at);
        context.beginPath();
        context.arc(x, y, coneRadius(curvature) * density, 0, 2 * Math.PI);
        context.fillStyle = palette[curvature < 0 ? 'negative' : 'positive'];
        context.strokeStyle = isLit(lit, cone) ? palette.lit : palette.rim;
        context.lineWidth = (isLit(lit, cone) ? 3 : 1) * density;
        context.fill();
        context.stroke();
      }
    }
  }
}

/** The radius of a cone's ball in pixels, a little smaller than in the base domain's picture, since most cones appear twice. */
function coneRadius(curvature: number): number {
  return 0.75 * ballRadius(curvature);
}

function isLit(lit: BasePart | null, cone: number): boolean {
  return lit?.kind === 'cone' && lit.index === cone;
}

/** What an exported drawing contains. */
export interface DrawnPlane {
  readonly curvatures: Float64Array;
  readonly names: readonly string[];
  readonly circles: 'shown' | 'hidden';
  readonly shown: number;
}

/** The size of an exported drawing, in pixels. */
export const PLANE_SIZE = { width: 900, height: 700 };

/** The plane as a self-contained SVG, dark on white: its triangles, circles, patch lines, cut and cones as groups. */
export function planeSvg(sheet: Sheet, { curvatures, names, circles, shown }: DrawnPlane): string {
  const placing: Placing = { ...PLANE_SIZE, ...fitted(sheet.box, PLANE_SIZE) };
  const pair = (at: Spot): string => across(placing, at).map((x) => x.toFixed(2)).join(' ');
  const path = (segments: readonly Segment[]): string =>
    segments.filter(({ when }) => when <= shown).map(({ from, to }) => `M${pair(from)}L${pair(to)}`).join('');
  const triangles = [...sheet.growth.order.subarray(0, shown)].map((face) => `M${sheet.corners(face).map(pair).join('L')}Z`).join('');
  const round = [...sheet.growth.vertices].flatMap((vertex, point) => {
    const radius = placing.scale * (sheet.mesh.radii[vertex] ?? 0);
    const [x = '', y = ''] = pair(sheet.spot(point)).split(' ');
    return (sheet.pointWhen[point] ?? 0) <= shown && radius > LEAST_CIRCLE ? [`<circle cx="${x}" cy="${y}" r="${radius.toFixed(2)}"/>`] : [];
  });
  const named = new Set<number>();
  const cones = sheet.cones.filter(({ when }) => when <= shown).map(({ cone, at }) => {
    const curvature = curvatures[cone] ?? 0;
    const [x, y] = across(placing, at);
    const label = named.has(cone) ? '' : `<text x="${(x + 8).toFixed(2)}" y="${(y + 4).toFixed(2)}" fill="${LIGHT.ink}" stroke="${PAPER}" stroke-width="3" paint-order="stroke">${escaped(names[cone] ?? String(cone + 1))}</text>`;
    named.add(cone);
    const colour = LIGHT[curvature < 0 ? 'negative' : 'positive'];
    return `<circle cx="${x.toFixed(2)}" cy="${y.toFixed(2)}" r="${coneRadius(curvature).toFixed(2)}" fill="${colour}" stroke="${LIGHT.rim}"/>${label}`;
  });
  const groups = [
    `<path id="triangles" d="${triangles}" fill="${mixed(LIGHT.face, LIGHTNESS)}" stroke="${LIGHT.side}" stroke-width="0.2"/>`,
    circles === 'shown' ? `<g id="circles" fill="none" stroke="${ACCENT.light}" stroke-width="0.5">${round.join('')}</g>` : '',
    `<path id="patch-lines" d="${path(sheet.borders)}" fill="none" stroke="${LIGHT.ink}" stroke-width="1"/>`,
    `<path id="cut" d="${path(sheet.cuts)}" fill="none" stroke="${CUT.light}" stroke-width="1.8"/>`,
    `<g id="cones">${cones.join('')}</g>`,
  ];
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${PLANE_SIZE.width}" height="${PLANE_SIZE.height}" viewBox="0 0 ${PLANE_SIZE.width} ${PLANE_SIZE.height}" font-family="system-ui, sans-serif" font-size="11" stroke-linejoin="round" stroke-linecap="round"><title>The flat metric in the plane</title><rect width="100%" height="100%" fill="${LIGHT.ground}"/>${groups.join('')}</svg>\n`;
}

/** The mesh as an OBJ file with its places in the plane as texture coordinates, cut where the layout is. */
export function planeObj({ mesh, growth }: Sheet): string {
  const triples = (numbers: Float32Array, size: number, word: string): string[] =>
    Array.from({ length: numbers.length / size }, (_, k) => `${word} ${[...numbers.subarray(size * k, size * k + size)].join(' ')}`);
  const corner = (k: number): string => `${(mesh.triangles[k] ?? 0) + 1}/${(growth.corners[k] ?? 0) + 1}`;
  const faces = Array.from({ length: mesh.triangles.length / 3 }, (_, f) => `f ${corner(3 * f)} ${corner(3 * f + 1)} ${corner(3 * f + 2)}`);
  return `${['# Texture coordinates: the flat cone metric in the plane', ...triples(mesh.positions, 3, 'v'), ...triples(growth.points, 2, 'vt'), ...faces].join('\n')}\n`;
}
