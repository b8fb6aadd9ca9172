/** The worker of the flat metrics in the plane: it computes the flows once, then layouts and pictures as they are asked for. */
import { PAPER } from '../colours.ts';
import { failureOf } from '../compute/messages.ts';
import { progressListener } from '../compute/progress-listener.ts';
import type { Side } from '../landmarks.ts';
import type { FlatPlanes } from '../wasm/core.js';
import init, { flatPlanes } from '../wasm/core.js';
import { fitted, PLANE_SIZE, PlanePainter, planeObj, planeSvg } from './plane-drawing.ts';
import type { GrownSide, PlaneAnswers, PlaneFileWish, PlaneMessage, PlaneQuestion, PlaneRequest } from './plane-messages.ts';
import type { MappedMesh } from './sheet.ts';
import { Sheet } from './sheet.ts';

declare const self: DedicatedWorkerGlobalScope;

/** How many pixels of a saved picture stand for one of the drawing. */
const SAVED_DENSITY = 2;

interface Desk {
  readonly request: PlaneRequest;
  readonly planes: FlatPlanes;
  readonly meshes: readonly [MappedMesh, MappedMesh];
  sides: readonly [Laid, Laid];
}

/** One mesh in the plane, with its painter. */
interface Laid {
  readonly sheet: Sheet;
  readonly painter: PlanePainter;
}

const LISTENER = progressListener((share) => {
  post({ kind: 'progress', share });
});

let desk: Desk | null = null;

function post(message: PlaneMessage, transfer: Transferable[] = []): void {
  self.postMessage(message, transfer);
}

function meshOf(planes: FlatPlanes, side: Side): MappedMesh {
  return {
    triangles: planes.triangles(side),
    positions: planes.positions(side),
    checkedFaces: planes.checkedFaces(side),
    landmarks: planes.landmarkVertices(side),
    radii: planes.radii(side),
  };
}

/** The layout of a mesh, grown from the middle of a patch. */
function laidFrom({ planes, request, meshes }: Omit<Desk, 'sides'>, side: Side, patch: number): Laid {
  const middle = request.base?.shapes[side].patchMiddles[patch] ?? 0;
  const grown = planes.grow(side, Math.max(0, meshes[side].checkedFaces.indexOf(middle)));
  const growth = {
    points: grown.points(),
    vertices: grown.vertices(),
    corners: grown.corners(),
    order: grown.order(),
    rings: grown.rings(),
    cut: grown.cut(),
    turnedOver: grown.turnedOver(),
  };
  grown.free();
  const sheet = new Sheet(meshes[side], growth, request.base, side, patch);
  return { sheet, painter: new PlanePainter(sheet, request.cones) };
}

function told({ sheet }: Laid): GrownSide {
  return { rings: sheet.growth.rings, box: sheet.box, turnedOver: sheet.growth.turnedOver, cutEdges: sheet.cuts.length / 2 };
}

async function fileOf({ sheet, painter }: Laid, { format, names, circles, shown, side }: PlaneFileWish, curvatures: Float64Array): Promise<Blob> {
  switch (format) {
    case 'svg':
      return new Blob([planeSvg(sheet, { curvatures, names, circles, shown })], { type: 'image/svg+xml' });
    case 'obj':
      return new Blob([planeObj(sheet)], { type: 'text/plain' });
    case 'png': {
      const size = { width: SAVED_DENSITY * PLANE_SIZE.width, height: SAVED_DENSITY * PLANE_SIZE.height };
      const placing = fitted(sheet.box, size, SAVED_DENSITY);
      const drawn = painter.draw({ side, ...size, ...placing, density: SAVED_DENSITY, shown, lit: null, circles, look: 'light' });
      const paper = new OffscreenCanvas(size.width, size.height);
      const context = paper.getContext('2d');
      if (context !== null) {
        context.fillStyle = PAPER;
        context.fillRect(0, 0, size.width, size.height);
        context.drawImage(drawn, 0, 0);
      }
      return paper.convertToBlob({ type: 'image/png' });
    }
  }
}

async function answerTo(at: Desk, asked: PlaneQuestion): Promise<PlaneAnswers[PlaneQuestion['kind']]> {
  switch (asked.kind) {
    case 'grow':
      at.sides = [laidFrom(at, 0, asked.question), laidFrom(at, 1, asked.question)];
      return [told(at.sides[0]), told(at.sides[1])];
    case 'draw':
      return at.sides[asked.question.side].painter.draw(asked.question).transferToImageBitmap();
    case 'ask': {
      const { side, x, y, reach, shown } = asked.question;
      return at.sides[side].sheet.partAt({ x, y }, reach, shown);
    }
    case 'save':
      return fileOf(at.sides[asked.question.side], asked.question, at.request.cones);
  }
}

async function begin(request: PlaneRequest): Promise<void> {
  await init({ module_or_path: request.module });
  const planes = flatPlanes(request.source, request.target, request.landmarks, request.cones, LISTENER);
  const begun = { request, planes, meshes: [meshOf(planes, 0), meshOf(planes, 1)] } as const;
  desk = { ...begun, sides: [laidFrom(begun, 0, 0), laidFrom(begun, 1, 0)] };
  post({ kind: 'ready' });
}

async function hear(message: PlaneRequest | PlaneQuestion): Promise<void> {
  try {
    if ('module' in message) {
      await begin(message);
    } else if (desk !== null) {
      const answer = await answerTo(desk, message);
      post({ kind: 'answer', number: message.number, answer }, answer instanceof ImageBitmap ? [answer] : []);
    }
  } catch (thrown) {
    post({ kind: 'failed', failure: failureOf(thrown) });
  }
}

self.addEventListener('message', (event: MessageEvent<PlaneRequest | PlaneQuestion>) => {
  void hear(event.data);
});
