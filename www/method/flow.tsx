/** Plays the flows of both meshes to their flat metrics: the conformal factor as colour, and the falling curvature error. */
import type { VNode } from 'preact';
import { useEffect, useMemo, useState } from 'preact/hooks';
import type { FlowMoment, Flows, SideFlow } from '../compute/watch-messages.ts';
import { download } from '../dom.ts';
import { figure, integer } from '../numbers.ts';
import { USUAL_SCHEME } from '../options.ts';
import { logMarks, markText } from '../plots/chart.ts';
import type { Scheme } from '../report.ts';
import { wordsOf } from '../unions.ts';
import type { MeshDefects } from '../wasm/page.js';
import { factorScale, unpackDefects } from '../wasm/page.js';
import { gradientOf, momentCount, placesAt, radiiAt, scaleEnd } from './factors.ts';
import './flow.css';
import { flowCsv, momentAt, residualRange } from './flow-table.ts';
import type { FlowHands, Listener } from './hands.ts';
import { usePlayed } from './played.ts';
import { STRUCTURES } from './structures.ts';
import { Computed, Transport } from './watched.tsx';

export interface FlowPlayerProps {
  readonly hands: FlowHands;
  /** Closes the flows. */
  readonly onClose: () => void;
}

/** The time from one Newton step to the next, in ms. */
const STEP_TIME = 1100;

const SIDES = [
  ['Source', 0, 'first'],
  ['Target', 1, 'second'],
] as const;

/** A share of time that runs slowly at both ends. */
function eased(share: number): number {
  return (1 - Math.cos(Math.PI * share)) / 2;
}

function Scale({ end }: { readonly end: number }): VNode {
  return (
    <div class="scale" role="img" aria-label={`Colours of the conformal factor: lengths shrink to 1/${end} on the left, stay in the middle, grow by ${end} on the right`}>
      <div class="bar" style={{ backgroundImage: gradientOf(factorScale()) }} />
      <div class="ticks">
        <span>1/{end} of its length</span>
        <span>1</span>
        <span>{end} times</span>
      </div>
    </div>
  );
}

const BOX = { width: 288, height: 120, left: 44, right: 280, top: 8, bottom: 96 };

/** A plot of the curvature error against the step, with a line at the present time. */
function Residuals({ flows, time }: { readonly flows: Flows; readonly time: number }): VNode {
  const [low, high] = residualRange(flows);
  const last = Math.max(1, ...flows.map(({ moments }) => moments.at(-1)?.step ?? 0));
  const across = (step: number): number => BOX.left + (step / last) * (BOX.right - BOX.left);
  const down = (residual: number): number =>
    BOX.bottom - (Math.log(Math.max(residual, low) / low) / Math.log(high / low)) * (BOX.bottom - BOX.top);
  // A time counts moments, of which a long flow has fewer than steps.
  const longer = flows[0].moments.length >= flows[1].moments.length ? flows[0] : flows[1];
  const [here, next] = [momentAt(longer, Math.floor(time)), momentAt(longer, Math.floor(time) + 1)];
  const now = across(here.step + (time - Math.floor(time)) * (next.step - here.step));
  const point = ({ step, residual }: FlowMoment): string => `${across(step).toFixed(1)} ${down(residual).toFixed(1)}`;
  return (
    <svg class="flow-residuals" viewBox={`0 0 ${BOX.width} ${BOX.height}`} role="img" aria-label="Largest curvature error in radians over the Newton steps of both flows, falling">
      {logMarks([low, high], 4).map((mark) => (
        <g key={mark}>
          <path class="grid" d={`M${BOX.left} ${down(mark)}H${BOX.right}`} />
          <text x={BOX.left - 6} y={down(mark) + 4} text-anchor="end">
            {markText(mark)}
          </text>
        </g>
      ))}
      <text x={BOX.left} y={BOX.height - 6}>
        0
      </text>
      <text x={BOX.right} y={BOX.height - 6} text-anchor="end">
        Newton step {last}
      </text>
      <path class="now" d={`M${now.toFixed(1)} ${BOX.top}V${BOX.bottom}`} />
      {SIDES.map(([name, side, colour]) => (
        <g key={name} class={colour}>
          <path d={`M${flows[side].moments.map(point).join('L')}`} />
          {flows[side].moments.map((moment) => (
            <circle key={moment.step} cx={across(moment.step)} cy={down(moment.residual)} r={2.5} />
          ))}
        </g>
      ))}
    </svg>
  );
}

function Numbers({ flows, moment }: { readonly flows: Flows; readonly moment: number }): VNode {
  return (
    <table class="flow-numbers small">
      <thead>
        <tr>
          <th scope="col">Flow</th>
          <th scope="col">Step</th>
          <th scope="col">Error (rad)</th>
          <th scope="col">Iterations</th>
          <th scope="col">Flips</th>
        </tr>
      </thead>
      <tbody>
        {SIDES.map(([name, side, colour]) => {
          const { step, residual, cgIterations, edgeFlips } = momentAt(flows[side], moment);
          return (
            <tr key={name} data-flow={side}>
              <th scope="row" class={colour}>
                {name}
              </th>
              <td>{integer(step)}</td>
              <td>{figure(residual)}</td>
              <td>{integer(cgIterations)}</td>
              <td>{integer(edgeFlips)}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

/** The marks in a view of the triangles that stopped a flow; `null` where none did. */
function stopsOf({ stops, packedStops }: SideFlow): MeshDefects | null {
  return stops.length === 0 ? null : unpackDefects(packedStops);
}

/** The most triangles that have a button of their own. */
const LISTED = 6;

/** The triangles at which the flows stopped, marked on the meshes. */
function Stops({ flows, hands }: { readonly flows: Flows; readonly hands: FlowHands }): VNode | null {
  const [marked, setMarked] = useState<readonly [MeshDefects | null, MeshDefects | null]>([null, null]);
  useEffect(() => {
    const found = [stopsOf(flows[0]), stopsOf(flows[1])] as const;
    setMarked(found);
    hands.mark(found);
    return () => {
      hands.mark(null);
      found.forEach((one) => one?.free());
    };
  }, [flows]);
  if (flows.every(({ converged }) => converged)) {
    return null;
  }
  return (
    <div role="status">
      {SIDES.filter(([, side]) => !flows[side].converged).map(([name, side]) => {
        const { stops, moments } = flows[side];
        const reached = `The ${name.toLowerCase()}’s flow stops after ${integer(moments.at(-1)?.step ?? 0)} steps, before it has the curvatures that were asked for`;
        return (
          <p class="small" key={name} data-stopped={side}>
            {stops.length === 0 ? `${reached}.` : `${reached}: beyond, ${stops.length === 1 ? 'a triangle has' : `${integer(stops.length)} triangles have`} no area.`}
            {stops.slice(0, LISTED).map((face, index) => {
              const found = marked[side];
              return (
                <button
                  type="button"
                  class="stop"
                  key={face}
                  disabled={found === null}
                  onClick={() => {
                    if (found !== null) {
                      hands.lookAtStop(side, found, index);
                    }
                  }}
                >
                  Show face {face}
                </button>
              );
            })}
          </p>
        );
      })}
    </div>
  );
}

function Player({ flows, hands, onClose }: FlowPlayerProps & { readonly flows: Flows }): VNode {
  const last = momentCount(flows) - 1;
  const { time, isPlaying, rest, toggle } = usePlayed(last, STEP_TIME);
  const end = useMemo(() => scaleEnd(flows), [flows]);
  const moment = Math.min(Math.floor(time), last);
  const places = useMemo(() => placesAt(flows, moment, end), [flows, moment, end]);
  const [hasCircles, setCircles] = useState(false);
  const radii = useMemo(() => (hasCircles ? radiiAt(flows, moment) : null), [flows, moment, hasCircles]);
  useEffect(() => {
    hands.show({ places, share: eased(time - moment), radii });
  }, [places, time, radii]);
  useEffect(
    () => () => {
      hands.show(null);
    },
    [],
  );
  const words = `step ${momentAt(flows[0], Math.round(time)).step} of the source, ${momentAt(flows[1], Math.round(time)).step} of the target`;
  return (
    <div class="watched">
      <Scale end={end} />
      <label class="check">
        <input
          type="checkbox"
          name="flow-circles"
          checked={hasCircles}
          disabled={flows.some((flow) => flow.radii.length === 0)}
          onChange={(event) => {
            setCircles(event.currentTarget.checked);
          }}
        />
        <span>Circles on the meshes</span>
      </label>
      <Transport name="flow" {...{ last, time, isPlaying, words, rest, toggle }} />
      <Residuals flows={flows} time={time} />
      <Numbers flows={flows} moment={moment} />
      <Stops flows={flows} hands={hands} />
      <div class="watched-row">
        <button
          type="button"
          aria-label="Save the steps of the flows as CSV"
          onClick={() => {
            download('conemap-flows.csv', 'text/csv', flowCsv(flows));
          }}
        >
          CSV
        </button>
        <button type="button" id="close-flow" onClick={onClose}>
          Back to the picture
        </button>
      </div>
    </div>
  );
}

/** The flows with the chosen structure, once they are computed. */
export default function FlowPlayer({ hands, onClose }: FlowPlayerProps): VNode {
  const [scheme, setScheme] = useState<Scheme>(USUAL_SCHEME);
  return (
    <div class="watched">
      <div role="radiogroup" aria-label="The discrete conformal structure of the flow" class="structures">
        {wordsOf(STRUCTURES).map((one) => (
          <label class="check" key={one}>
            <input
              type="radio"
              name="flow-structure"
              value={one}
              checked={scheme === one}
              onChange={() => {
                setScheme(one);
              }}
            />
            <span>{STRUCTURES[one].name}</span>
          </label>
        ))}
      </div>
      <p class="quiet small">{STRUCTURES[scheme].about}</p>
      <Computed
        key={scheme}
        hands={{ start: (listener: Listener<Flows>) => hands.start(listener, scheme) }}
        sentence="Computing both flows again, step by step…"
        onClose={onClose}
      >
        {(flows) => <Player hands={hands} onClose={onClose} flows={flows} />}
      </Computed>
    </div>
  );
}
