/** Drawings of surfaces and their metrics: landmarks on a limb, a twist, a cone, distortion, a winding, circles. */
import type { VNode } from 'preact';
import { useState } from 'preact/hooks';
import { figure } from '../../numbers.ts';
import { angle, between, distance, distortion, edgeLength, pathLength, point, polar, spiral } from '../geometry.ts';
import type { Point } from '../geometry.ts';
import { Dot, Drawing, HEIGHT, Path, Ring, Shape, Slider, WIDTH, Words } from './frame.tsx';

const TAU = 2 * Math.PI;
const MIDDLE = point(WIDTH / 2, HEIGHT / 2);

function arc(centre: Point, radius: number, from: number, to: number): readonly Point[] {
  return Array.from({ length: 49 }, (_, k) => polar(from + ((to - from) * k) / 48, radius, centre));
}

/** An ellipse with its axes along the sheet's. */
function ellipse(centre: Point, across: number, up: number, from = 0, to = TAU): readonly Point[] {
  return arc(point(0, 0), 1, from, to).map(({ x, y }) => point(centre.x + across * x, centre.y + up * y));
}

function Limb({ left, around }: { readonly left: number; readonly around: boolean }): VNode {
  const tip = point(left + 52, 128);
  const outline = [point(left + 30, 28), ...arc(tip, 22, Math.PI, 0), point(left + 74, 28)];
  const [front, back] = [ellipse(point(tip.x, 104), 22, 7, Math.PI, TAU), ellipse(point(tip.x, 104), 22, 7, 0, Math.PI)];
  const points = around
    ? [polar(-2.3, 1), polar(-0.8, 1), polar(1.3, 1)].map(({ x, y }) => point(tip.x + 22 * x, 104 + 7 * y))
    : [44, 82, 120].map((y) => point(tip.x, y));
  return (
    <>
      <Shape points={outline} look="body" />
      {around ? (
        <>
          <Path points={back} look="line quiet dashed" />
          <Path points={front} look="line accent" />
        </>
      ) : (
        <Path points={points} look="line doubt" />
      )}
      {points.map((p, k) => (
        <Dot key={k} at={p} look={around ? 'dot good' : 'dot bad'} size={5} />
      ))}
      <Words at={point(tip.x, 8)}>{around ? 'holds the limb' : 'lets it turn'}</Words>
    </>
  );
}

/** Two limbs: one with three landmarks around it, one with three along it. */
export function LimbLandmarks(): VNode {
  return (
    <figure>
      <Drawing says="Two limbs. Left three landmarks in a ring around the end, which hold the limb; right three in a line along it, about which it can turn.">
        <Limb left={20} around />
        <Limb left={152} around={false} />
      </Drawing>
    </figure>
  );
}

const RIM = { inner: 20, outer: 78 };
const STARTS = [0, 1, 2].map((k) => Math.PI / 2 + (k * TAU) / 3);

/** Paths on a limb, seen from its tip, from the end to the root, twisted by a number of turns. */
export function Twist(): VNode {
  const [turns, setTurns] = useState(1);
  const paths = STARTS.map((start) => spiral(RIM.inner, RIM.outer, start, turns, 160).map(({ x, y }) => point(x + MIDDLE.x, y + MIDDLE.y)));
  const times = pathLength(paths[0] ?? []) / (RIM.outer - RIM.inner);
  const word = turns === 0 ? 'no twist' : Math.abs(turns) === 1 ? 'one twist' : `${Math.abs(turns)} twists`;
  const text = `${word}: paths ${times.toFixed(1)} times as long`;
  return (
    <figure>
      <Drawing says={`A limb seen from its end, with three paths from its tip to its root: ${text}.`}>
        <Ring at={MIDDLE} radius={RIM.outer} look="face" />
        <Ring at={MIDDLE} radius={RIM.inner} look="face" />
        {paths.map((path, k) => (
          <Path key={k} points={path} look={turns === 0 ? 'strong accent' : 'strong doubt'} />
        ))}
        {STARTS.flatMap((start) => [RIM.inner, RIM.outer].map((radius) => (
          <Dot key={`${start} ${radius}`} at={polar(start, radius, MIDDLE)} look="dot" />
        )))}
      </Drawing>
      <Slider label="Twists" value={turns} range={[-2, 2, 1]} text={text} onInput={setTurns} />
    </figure>
  );
}

const CONE = { flat: point(84, 84), radius: 74, side: 70 };

/** A cone cut open: its curvature is the angle that is missing from the full disc. */
export function Cone(): VNode {
  const [degrees, setDegrees] = useState(250);
  const theta = (degrees * Math.PI) / 180;
  const start = (TAU - theta) / 2;
  const sector = [CONE.flat, ...arc(CONE.flat, CONE.radius, start, TAU - start)];
  // A circle around the apex has the length theta times its distance from the apex, and so the cone's slope follows from theta.
  const slope = theta / TAU;
  const foot = point(222, 40);
  const [across, height] = [CONE.side * slope, CONE.side * Math.sqrt(Math.max(0, 1 - slope * slope))];
  const apex = point(foot.x, foot.y + height);
  const text = `θ = ${degrees}°, curvature K = ${360 - degrees}°`;
  return (
    <figure>
      <Drawing says={`A cone, and the same one cut open and laid flat: ${text}.`}>
        <Ring at={CONE.flat} radius={CONE.radius} look="line quiet dashed" />
        <Shape points={sector} look="face" />
        {[start, TAU - start].map((edge) => (
          <Path key={edge} points={[CONE.flat, polar(edge, CONE.radius, CONE.flat)]} look="strong accent" />
        ))}
        <Path points={arc(CONE.flat, 22, start, TAU - start)} look="line doubt" />
        <Dot at={CONE.flat} look="dot" />
        <Shape points={ellipse(foot, across, across * 0.3)} look="face" />
        <Path points={[point(foot.x - across, foot.y), apex, point(foot.x + across, foot.y)]} look="line ink" />
        <Path points={[apex, point(foot.x, foot.y - across * 0.3)]} look="strong accent" />
        <Dot at={apex} look="dot" />
      </Drawing>
      <Slider label="Angle" value={degrees} range={[60, 360, 5]} text={text} onInput={setDegrees} />
    </figure>
  );
}

/** A circle that becomes an ellipse under a linear map. */
export function Distorted(): VNode {
  const [s1, setFirst] = useState(1.4);
  const [s2, setSecond] = useState(0.8);
  const { density, angle: angles, area } = distortion(s1, s2);
  const unit = 38;
  const text = `D = ${density.toFixed(2)}, angles ${angles.toFixed(2)}, area ${area.toFixed(2)}`;
  return (
    <figure>
      <Drawing says={`A circle and its image, an ellipse. ${text}.`}>
        <Ring at={MIDDLE} radius={unit} look="line quiet dashed" />
        <Shape points={ellipse(MIDDLE, unit * s1, unit * s2)} look="area accent" />
        <Path points={[MIDDLE, point(MIDDLE.x + unit * s1, MIDDLE.y)]} look="strong accent" />
        <Path points={[MIDDLE, point(MIDDLE.x, MIDDLE.y + unit * s2)]} look="strong doubt" />
        <Words at={point(MIDDLE.x, 8)}>{text}</Words>
      </Drawing>
      <Slider label="σ₁" value={s1} range={[0.5, 2, 0.05]} text={s1.toFixed(2)} onInput={setFirst} />
      <Slider label="σ₂" value={s2} range={[0.5, 2, 0.05]} text={s2.toFixed(2)} onInput={setSecond} />
    </figure>
  );
}

/** Five positively oriented triangles around a vertex, which go around it once or twice. */
export function Winding(): VNode {
  const [times, setTimes] = useState(2);
  const corners = Array.from({ length: 5 }, (_, k) => polar(Math.PI / 2 + (k * times * TAU) / 5, 76, point(MIDDLE.x, 78)));
  const centre = point(MIDDLE.x, 78);
  const faces = corners.map((p, k) => [centre, p, corners[(k + 1) % 5] ?? p] as const);
  const sum = faces.reduce((total, [apex, a, b]) => total + angle(apex, a, b), 0);
  const text = `angle sum ${Math.round((180 / Math.PI) * sum)}°: ${times === 1 ? 'one sheet' : 'two sheets'}`;
  return (
    <figure>
      <Drawing says={`Five triangles around a vertex, all positive; ${text}.`}>
        {faces.map((face, k) => (
          <Shape key={k} points={face} look={times === 1 ? 'area good' : 'area bad'} />
        ))}
        <Dot at={centre} look={times === 1 ? 'dot good' : 'dot bad'} size={5} />
      </Drawing>
      <Slider label="Winds" value={times} range={[1, 2, 1]} text={text} onInput={setTimes} />
    </figure>
  );
}

const RADII = [46, 34] as const;

/** Two circles at the ends of an edge, at a given inversive distance. */
export function Circles(): VNode {
  const [eta, setEta] = useState(1.3);
  const length = edgeLength(RADII, eta);
  const [a, b] = [point(MIDDLE.x - length / 2 + 6, MIDDLE.y), point(MIDDLE.x + length / 2 + 6, MIDDLE.y)];
  const how = eta === 0 ? 'they cross at right angles' : eta < 1 ? 'they cross' : eta === 1 ? 'they touch' : 'they are apart';
  const text = `η = ${eta.toFixed(2)}: ${how}`;
  return (
    <figure>
      <Drawing says={`Two circles around the ends of an edge. ${text}; the edge has length ${figure(distance(a, b) / RADII[0])} in radii of the first.`}>
        <Ring at={a} radius={RADII[0]} look="area accent" />
        <Ring at={b} radius={RADII[1]} look="area accent" />
        <Path points={[a, b]} look="strong accent" />
        <Dot at={a} look="dot" />
        <Dot at={b} look="dot" />
        <Words at={point(between(a, b, 0.5).x, MIDDLE.y + 8)}>ℓ</Words>
      </Drawing>
      <Slider label="η" value={eta} range={[0, 2, 0.05]} text={text} onInput={setEta} />
    </figure>
  );
}
