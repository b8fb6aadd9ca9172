/** Works to send: small ones written by hand, and random ones of any kind. */
import type { SurfacePoint } from '../../../www/landmarks.ts';
import { rounded } from '../../../www/landmarks.ts';
import { BASES, BORDERS, CLASSES, CONES, METHODS } from '../../../www/options.ts';
import type { Link, LinkedFile } from '../../../www/send/link.ts';
import type { SentPair, SentWork } from '../../../www/send/schema.ts';
import { INITIAL } from '../../../www/store/state.ts';
import type { Axis } from '../../../www/store/work.ts';
import { wordsOf } from '../../../www/unions.ts';
import type { Random } from '../random.ts';

export const BASE = new URL('https://maps.example/conemap/');

const AXES = wordsOf<Axis>({ x: true, '-x': true, y: true, '-y': true, z: true, '-z': true });

/** The weights of a place in a face, whose sum is 1 up to rounding. */
function weights(random: Random): [number, number, number] {
  const [a, b] = [random.unit(), random.unit()];
  const [first, second] = a + b > 1 ? [1 - a, 1 - b] : [a, b];
  return [first, second, 1 - first - second];
}

/** A click on a mesh of this many faces, as the page keeps it. */
export function click(random: Random, faces: number): SurfacePoint {
  return rounded({ face: random.below(faces), barycentric: weights(random) });
}

function anyPoint(random: Random): SurfacePoint | null {
  switch (random.below(4)) {
    case 0:
      return random.below(2 ** 32);
    case 1:
      return { face: random.below(1e6), barycentric: weights(random) };
    case 2:
      return rounded({ face: random.below(10), barycentric: random.of([[1, 0, 0], [0.5, 0.5, 0], [1 / 3, 1 / 3, 1 / 3]]) });
    default:
      return click(random, 500_000);
  }
}

function anyPairs(random: Random): SentPair[] {
  const inOrder = random.unit() < 0.5;
  const named = random.unit() < 0.5;
  return Array.from({ length: random.below(60) }, (_, index): SentPair => {
    const half = random.below(12);
    return {
      number: inOrder ? index + 1 : 3 * index + 2,
      points: [half === 0 ? null : anyPoint(random), half === 1 ? null : anyPoint(random)],
      label: named ? random.of(['', 'left ear', 'Schwanz', '左の耳', '"\\ \u2028<b>']) : '',
      locked: random.unit() < 0.1,
      ...(random.unit() < 0.2 ? { radius: 0.001 + 0.2 * random.unit() } : {}),
    };
  });
}

/** A camera whose numbers are rounded as in a link. */
function camera(random: Random): number[] {
  return Array.from({ length: 10 }, () => Number((random.unit() * 4 - 2).toPrecision(5)));
}

export function anyWork(random: Random): SentWork {
  return {
    pairs: anyPairs(random),
    up: [random.of(AXES), random.of(AXES)],
    groundTruth: random.of([null, 'same connectivity: vertex i corresponds to vertex i']),
    options: {
      method: random.of(wordsOf(METHODS)),
      base: random.of(wordsOf(BASES)),
      cones: random.of(wordsOf(CONES)),
      class: random.of(wordsOf(CLASSES)),
      ownCones: random.of([null, 0, 20]),
      borders: random.of(wordsOf(BORDERS)),
    },
    cameras: [random.of([null, camera(random)]), random.of([null, camera(random)])],
    style: {
      surface: random.of(['shaded', 'checkerboard', 'picture', 'colours', 'distortion', 'truth', 'flat-curvature']),
      texture: random.of([INITIAL.ui.style.texture, { cells: 7.5, turn: -90, x: 0.25, y: 9 }]),
      patchLines: random.of([true, false]),
      cones: random.of([true, false]),
      markers: random.of([true, false]),
      textureBoundary: random.of([true, false]),
      morph: random.of([0, 0.37, 1]),
      wipe: random.of([null, 0, 0.4375]),
    },
  };
}

export function localFile(name: string, letter = 'A'): LinkedFile {
  return { kind: 'local', name, hash: letter.repeat(43) };
}

export function addressFile(url: string): LinkedFile {
  const { host, pathname } = new URL(url);
  return { kind: 'address', address: { url, name: pathname.slice(pathname.lastIndexOf('/') + 1), host } };
}

function demoFile(id: string, side: 0 | 1): LinkedFile {
  return { kind: 'demo', id, side };
}

export function anyLink(random: Random): Link {
  const isDemo = random.unit() < 0.3;
  const file = (): LinkedFile => random.of([localFile('cat.off', random.of(['A', 'b', '-', '_', '7'])), addressFile('https://data.example/a/cat.obj?b=c&d=1'), demoFile(random.of(['ball', 'ü=1']), random.of([0, 1]))]);
  const one = file();
  return {
    demo: isDemo ? random.of(['ball', 'cat & dog', 'ü=1']) : null,
    files: isDemo ? [null, null] : random.of([[one, file()], [one, null], [null, one]] as const),
    landmarks: null,
    work: anyWork(random),
  };
}

/** Work with pairs that were clicked in the page, on meshes of half a million faces. */
export function clickedWork(random: Random, pairs: number): SentWork {
  return {
    ...anyWork(random),
    pairs: Array.from({ length: pairs }, (_, index) => ({
      number: index + 1,
      points: [click(random, 500_000), click(random, 500_000)],
      label: '',
      locked: false,
    })),
    groundTruth: null,
    options: INITIAL.options,
    cameras: [camera(random), camera(random)],
    style: INITIAL.ui.style,
  };
}
