/**
 * Links: reads what an address holds behind its `#`, and writes the address of what is on the page. Three forms are read: `#demo=name`,
 * `#source=URL&target=URL&landmarks=URL`, and `#s=1.` or `#s=2.` with packed JSON. A link may come from anybody: its length is checked first, then the
 * shape of every part; a link that fails is refused with the reason.
 */
import * as v from 'valibot';
import type { Side } from '../landmarks.ts';
import type { LinkFault } from '../messages.ts';
import type { Camera, Style } from '../store/state.ts';
import { INITIAL } from '../store/state.ts';
import type { DemoMesh } from '../store/work.ts';
import type { Address } from './address.ts';
import { addressOf, shownName } from './address.ts';
import { pack, unpack } from './packing.ts';
import { areSound } from './schema.ts';
import type { SentPair, SentWork } from './schema.ts';
import { LATEST, surfacePoint, WireLink, wirePoint } from './wire.ts';
import type { WireFile, WirePoint, WrittenLink } from './wire.ts';

/** The most characters behind the `#`, with the `#`. */
export const LONGEST_LINK = 65_536;
/** The most bytes of the JSON in a link, several times what the longest valid one unpacks to. */
export const LARGEST_JSON = 400_000;

/** A mesh that a link names: a file at an address, the mesh of a demo, or a file that whoever opens the link must have. */
export type LinkedFile =
  | { readonly kind: 'address'; readonly address: Address }
  | ({ readonly kind: 'demo' } & DemoMesh)
  | { readonly kind: 'local'; readonly name: string; readonly hash: string };

/** The content of a link. */
export interface Link {
  /** The id of the demo whose meshes these are; `null` where the link names files. */
  readonly demo: string | null;
  readonly files: readonly [LinkedFile | null, LinkedFile | null];
  /** The address of a landmark file; `null` for none. */
  readonly landmarks: Address | null;
  /** The work on the meshes; `null` where the link leaves it to the demo or the landmark file. */
  readonly work: SentWork | null;
}

/** The result of reading a link; `none` where the address has nothing behind the `#`. */
export type Reading =
  | { readonly kind: 'none' }
  | { readonly kind: 'link'; readonly link: Link }
  | { readonly kind: 'refused'; readonly fault: LinkFault };

const NONE: Reading = { kind: 'none' };

function refused(fault: LinkFault): Reading {
  return { kind: 'refused', fault };
}

/** Reads the link in an address; `hash` begins with the `#`, and `base` is the address of the page. */
export function readLink(hash: string, base: URL): Reading {
  if (hash.length > LONGEST_LINK) {
    return refused('too-long');
  }
  const parts = new URLSearchParams(hash.replace(/^#/, ''));
  const packed = parts.get('s');
  if (packed !== null) {
    return readPacked(packed, base);
  }
  if (['source', 'target', 'landmarks'].some((part) => parts.has(part))) {
    return readAddresses(parts, base);
  }
  const demo = parts.get('demo');
  return demo === null || demo === ''
    ? NONE
    : { kind: 'link', link: { demo, files: [null, null], landmarks: null, work: null } };
}

/** The error of a refused link; it is thrown and caught only in this file. */
class Refused extends Error {
  readonly fault: LinkFault;

  constructor(fault: LinkFault) {
    super(fault);
    this.fault = fault;
  }
}

function address(text: string, base: URL): Address {
  const found = addressOf(text, base);
  if (typeof found === 'string') {
    throw new Refused(found);
  }
  return found;
}

/** The result of a function that throws {@link Refused} where it refuses the link. */
function reading(read: () => Link): Reading {
  try {
    return { kind: 'link', link: read() };
  } catch (thrown) {
    if (thrown instanceof Refused) {
      return refused(thrown.fault);
    }
    throw thrown;
  }
}

function readAddresses(parts: URLSearchParams, base: URL): Reading {
  const part = (name: string): Address | null => {
    const text = parts.get(name);
    return text === null ? null : address(text, base);
  };
  const file = (name: string): LinkedFile | null => {
    const found = part(name);
    return found === null ? null : { kind: 'address', address: found };
  };
  return reading(() => {
    const files = [file('source'), file('target')] as const;
    if (files[0] === null && files[1] === null) {
      throw new Refused('no-mesh');
    }
    return { demo: null, files, landmarks: part('landmarks'), work: null };
  });
}

function readPacked(packed: string, base: URL): Reading {
  const [, version, body] = /^(\d{1,9})\.(.*)$/s.exec(packed) ?? [];
  if (version === undefined || body === undefined) {
    return refused('damaged');
  }
  if (Number(version) > LATEST || Number(version) < 1) {
    return refused(Number(version) > LATEST ? 'newer' : 'damaged');
  }
  const json = unpack(body, LARGEST_JSON);
  const wire = json === null ? null : v.safeParse(v.pipe(v.string(), v.parseJson(), WireLink), json, { abortEarly: true });
  if (wire?.success !== true) {
    return refused('damaged');
  }
  return reading(() => linkOf(wire.output, base));
}

function linkedFile(file: WireFile, base: URL): LinkedFile | null {
  const [first, name] = file;
  if (first === undefined) {
    return null;
  }
  if (name === undefined) {
    return { kind: 'address', address: address(first, base) };
  }
  return typeof name === 'number' ? { kind: 'demo', id: first, side: name } : { kind: 'local', hash: first, name: shownName(name) };
}

function linkOf(wire: WireLink, base: URL): Link {
  const files = (wire.f ?? [[], []]).map((file) => linkedFile(file, base));
  const [source = null, target = null] = files;
  if ((wire.d === undefined) === (source === null && target === null)) {
    throw new Refused(wire.d === undefined ? 'no-mesh' : 'damaged');
  }
  return { demo: wire.d ?? null, files: [source, target], landmarks: null, work: workOf(wire) };
}

function pairsOf({ p, i, n, x, r }: WireLink): readonly SentPair[] {
  const [source, target] = p;
  const locked = new Set(x);
  const radii = new Map(r);
  const numbers = i ?? source.map((_, index) => index + 1);
  const pairs = source.map((point, index) => {
    const radius = radii.get(index);
    return {
      number: numbers[index] ?? 0,
      points: [surfacePoint(point), surfacePoint(target[index] ?? [])] as const,
      label: n?.[index] ?? '',
      locked: locked.has(index),
      ...(radius === undefined ? {} : { radius }),
    };
  });
  if (source.length !== target.length || numbers.length !== source.length || !areSound(pairs)) {
    throw new Refused('damaged');
  }
  return pairs;
}

function workOf(wire: WireLink): SentWork {
  return {
    pairs: pairsOf(wire),
    up: wire.u,
    groundTruth: wire.g ?? null,
    options: wire.o,
    cameras: wire.c,
    style: wire.s,
  };
}

function wireFile(file: LinkedFile | null): WireFile {
  switch (file?.kind) {
    case undefined:
      return [];
    case 'address':
      return [file.address.url];
    case 'demo':
      return [file.id, file.side];
    case 'local':
      return [file.hash, file.name];
  }
}

/** The number of digits that are kept of a camera's numbers: finer than a pixel. */
const CAMERA_FIGURES = 5;

function wireCamera(camera: Camera | null): number[] | null {
  return camera?.map((value) => Number(value.toPrecision(CAMERA_FIGURES))) ?? null;
}

/** The style without fields that have their usual values and that links of earlier versions do not have. */
function wireStyle({ textureBoundary, texture, ...style }: Style): WrittenLink['s'] {
  const usual = INITIAL.ui.style.texture;
  const isUsual = texture.cells === usual.cells && texture.turn === usual.turn && texture.x === usual.x && texture.y === usual.y;
  return { ...style, ...(textureBoundary ? { textureBoundary } : {}), ...(isUsual ? {} : { texture }) };
}

function wireLink(link: Link, work: SentWork): WrittenLink {
  const { pairs } = work;
  const { borders, ...options } = work.options;
  const points = (side: Side): WirePoint[] => pairs.map((pair) => wirePoint(pair.points[side]));
  const labels = pairs.map(({ label }) => label);
  const locked = pairs.flatMap((pair, index) => (pair.locked ? [index] : []));
  const radii = pairs.flatMap(({ radius }, index) => (radius === undefined ? [] : [[index, radius] as [number, number]]));
  return {
    ...(link.demo === null ? { f: [wireFile(link.files[0]), wireFile(link.files[1])] } : { d: link.demo }),
    p: [points(0), points(1)],
    ...(pairs.every(({ number }, index) => number === index + 1) ? {} : { i: pairs.map(({ number }) => number) }),
    ...(labels.every((label) => label === '') ? {} : { n: labels }),
    ...(locked.length === 0 ? {} : { x: locked }),
    ...(radii.length === 0 ? {} : { r: radii }),
    ...(work.groundTruth === null ? {} : { g: work.groundTruth }),
    u: [...work.up],
    // The usual choice is left out, as in links from before this was a choice.
    o: borders === 'guess' ? options : work.options,
    c: [wireCamera(work.cameras[0]), wireCamera(work.cameras[1])],
    s: wireStyle(work.style),
  };
}

/** The link with its `#`, to stand behind the page's address. */
export function writeLink(link: Link): string {
  if (link.work !== null) {
    const version = link.files.some((file) => file?.kind === 'demo') ? LATEST : 1;
    return `#s=${version}.${pack(JSON.stringify(wireLink(link, link.work)))}`;
  }
  if (link.demo !== null) {
    return `#demo=${encodeURIComponent(link.demo)}`;
  }
  const address = (name: string, found: Address | null): string[] =>
    found === null ? [] : [`${name}=${encodeURIComponent(found.url)}`];
  const file = (name: string, found: LinkedFile | null): string[] =>
    found?.kind === 'address' ? address(name, found.address) : [];
  const [source, target] = link.files;
  return `#${[...file('source', source), ...file('target', target), ...address('landmarks', link.landmarks)].join('&')}`;
}
