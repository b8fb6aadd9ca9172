/** Drawings of triangulations: a collapse, the base domain, the star of a vertex, the overlay of two meshes, a flip. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import type { Point } from '../geometry.ts';
import { angle, area, between, circumcircle, intersection, kernel, orientation, point, stacked } from '../geometry.ts';
import { Dot, Drawing, Path, Ring, Shape, Slider } from './frame.tsx';

const ORIGIN = point(0, 0);

function at(points: readonly Point[], index: number): Point {
  return points[index] ?? ORIGIN;
}

const KEPT = point(110, 84);
const GOING = point(170, 84);
/** The neighbours of both ends of the edge, then those of each end alone, counter-clockwise. */
const AROUND = [point(140, 140), point(80, 144), point(44, 84), point(82, 26), point(140, 28), point(206, 30), point(236, 86), point(200, 142)];

/** A collapse: the slider shortens an edge, and at its end the edge is gone with two triangles. */
export function Collapse(): VNode {
  const [share, setShare] = useState(0.4);
  const moved = between(GOING, KEPT, share);
  const isGone = share === 1;
  const faces = AROUND.map((p, k) => {
    const q = at(AROUND, (k + 1) % AROUND.length);
    return [p, q, k < 4 ? KEPT : moved];
  });
  const thin = [
    [KEPT, moved, at(AROUND, 0)],
    [moved, KEPT, at(AROUND, 4)],
  ];
  const text = isGone ? '8 triangles' : '10 triangles';
  return (
    <figure>
      <Drawing says={`An edge between two vertices shrinks to a point: ${text}.`}>
        {faces.map((face, k) => (
          <Shape key={k} points={face} look="face" />
        ))}
        {!isGone && thin.map((face, k) => <Shape key={k} points={face} look="face accent" />)}
        <Path points={[KEPT, moved]} look="strong" />
        <Dot at={moved} look="dot" />
        <Dot at={KEPT} look="dot accent" />
      </Drawing>
      <Slider label="Collapse" value={share} range={[0, 1, 0.05]} text={text} onInput={setShare} />
    </figure>
  );
}

const OUTER = [point(20, 14), point(260, 14), point(140, 158)] as const;

/** The base domain, which grows by one landmark at a time. */
export function BaseDomain(): VNode {
  const [count, setCount] = useState(7);
  const { points, faces } = stacked(OUTER, count);
  const text = `${count} landmarks: ${3 * count - 6} edges, ${2 * count - 4} triangles`;
  return (
    <figure>
      <Drawing says={`A triangulation with its landmarks as corners. ${text}, one of them the outside.`}>
        {faces.map((face) => (
          <Shape key={face.join()} points={face.map((v) => at(points, v))} look="face" />
        ))}
        {points.map((p, v) => (
          <Dot key={v} at={p} look="dot accent" size={4} />
        ))}
      </Drawing>
      <Slider label="Landmarks" value={count} range={[4, 16, 1]} text={text} onInput={setCount} />
    </figure>
  );
}

const STAR = [point(40, 24), point(236, 20), point(246, 138), point(150, 96), point(44, 146)];

/** A vertex that moves in its star: it is allowed wherever it sees every edge of the star from the edge's left. */
export function Star(): VNode {
  const [x, setX] = useState(120);
  const vertex = point(x, 74);
  const faces = STAR.map((p, k) => [p, at(STAR, (k + 1) % STAR.length), vertex] as const);
  const flipped = faces.filter(([a, b, c]) => orientation(a, b, c) <= 0).length;
  const text = flipped === 0 ? 'all five triangles positive' : flipped === 1 ? 'one triangle flipped' : `${flipped} triangles flipped`;
  return (
    <figure>
      <Drawing says={`A vertex in the star of its neighbours, with the kernel shaded: ${text}.`}>
        {faces.map(([a, b, c], k) => (
          <Shape key={k} points={[a, b, c]} look={orientation(a, b, c) > 0 ? 'face' : 'face bad'} />
        ))}
        <Shape points={kernel(STAR)} look="area good" />
        <Dot at={vertex} look={flipped === 0 ? 'dot good' : 'dot bad'} size={5} />
      </Drawing>
      <Slider label="Vertex" value={x} range={[60, 226, 2]} text={text} onInput={setX} />
    </figure>
  );
}

const SQUARE = [point(60, 4), point(220, 4), point(220, 164), point(60, 164)];
const SQUARE_AREA = 160 * 160;

function fan(centre: Point): readonly (readonly Point[])[] {
  return SQUARE.map((p, k) => [p, at(SQUARE, (k + 1) % 4), centre]);
}

/** Two triangulations of one square and their common pieces. */
export function Overlay(): VNode {
  const [x, setX] = useState(96);
  const [source, target] = [fan(point(150, 110)), fan(point(x, 62))];
  // Neighbouring pieces get different looks: crossing an edge of either mesh changes the parity of i + k.
  const pieces = source
    .flatMap((a, i) => target.map((b, k) => ({ corners: intersection(a, b), look: (i + k) % 2 === 0 ? 'piece' : 'piece other' })))
    .filter(({ corners }) => area(corners) > 1e-9 * SQUARE_AREA);
  const share = pieces.reduce((sum, { corners }) => sum + area(corners), 0) / SQUARE_AREA;
  const text = `${pieces.length} pieces, ${(100 * share).toFixed(1)} % covered`;
  return (
    <figure>
      <Drawing says={`Two triangulations over each other: ${text}.`}>
        {pieces.map(({ corners, look }, k) => (
          <Shape key={k} points={corners} look={look} />
        ))}
        {source.map((face, k) => (
          <Shape key={k} points={face} look="line accent" />
        ))}
        {target.map((face, k) => (
          <Shape key={k} points={face} look="line doubt" />
        ))}
      </Drawing>
      <Slider label="Target" value={x} range={[76, 204, 2]} text={text} onInput={setX} />
    </figure>
  );
}

const [LEFT, RIGHT, TOP] = [point(70, 80), point(214, 88), point(136, 152)];

/** A flip: the edge of two triangles is flipped once the opposite corner lies in the circle through the other three. */
export function Flip(): VNode {
  const [depth, setDepth] = useState(40);
  const under = point(150, 84 - depth);
  const circle = circumcircle(LEFT, RIGHT, TOP);
  const sum = angle(TOP, LEFT, RIGHT) + angle(under, LEFT, RIGHT);
  const isFlipped = sum > Math.PI;
  const faces = isFlipped
    ? [[TOP, LEFT, under], [under, RIGHT, TOP]]
    : [[LEFT, RIGHT, TOP], [RIGHT, LEFT, under]];
  const degrees = `${((180 / Math.PI) * sum).toFixed(0)}°`;
  const text = `α + β = ${degrees}: ${isFlipped ? 'flipped' : 'the edge stays'}`;
  return (
    <figure>
      <Drawing says={`Two triangles and the circle through three of their corners. ${text}.`}>
        {faces.map((face, k) => (
          <Shape key={k} points={face} look="face" />
        ))}
        <Ring at={circle.centre} radius={circle.radius} look="line quiet" />
        <Path points={isFlipped ? [TOP, under] : [LEFT, RIGHT]} look={isFlipped ? 'strong doubt' : 'strong accent'} />
        {[LEFT, RIGHT, TOP, under].map((p, k) => (
          <Dot key={k} at={p} look="dot" />
        ))}
      </Drawing>
      <Slider label="Corner" value={depth} range={[12, 76, 2]} text={text} onInput={setDepth} />
    </figure>
  );
}
