/**
 * What is watched: the flows of the run, on a scale that contains them, as numbers and as a table; and the simplification by its stages.
 */
import { beforeAll, describe, expect, test } from 'vitest';
import type { Flows, SideFlow, Simplification } from '../../www/compute/watch-messages.ts';
import { momentCount, placeOf, placesAt, radiiAt, scaleEnd } from '../../www/method/factors.ts';
import { flowCsv, momentAt, residualRange } from '../../www/method/flow-table.ts';
import { countAt, stageAt, stageCount } from '../../www/method/stages.ts';
import { historyOf, nearestVertex, trailOf } from '../../www/method/trails.ts';
import { STRUCTURES } from '../../www/method/structures.ts';
import type { DefectGroup } from '../../www/store/defects.ts';
import type { Report } from '../../www/report.ts';
import { wordsOf } from '../../www/unions.ts';
import type { MapOutput, RecordedFlows, Simplifications } from '../../www/wasm/core.js';
import { buildDemo, recordFlows, recordSimplifications, runMap } from '../../www/wasm/core.js';
import { factorScale, unpackDefects } from '../../www/wasm/page.js';
import { CORNERS, rod } from './rod.ts';
import { startCoreModule, startPageModule } from './modules.ts';

const nothing = (): void => undefined;
const LISTENER = { relaxes: nothing, progress: nothing, preview: nothing, found: nothing, wantsResult: (): boolean => false };

describe('the flows of a map', () => {
  let output: MapOutput;
  let flows: RecordedFlows;
  let vertices: number;
  let stages: Simplifications;

  beforeAll(() => {
    startCoreModule();
    startPageModule();
    const demo = buildDemo('sphere-tetrahedron');
    if (demo === undefined) {
      throw new Error('no demo');
    }
    const landmarks = new TextDecoder().decode(demo.landmarks());
    output = runMap(demo.source(), demo.target(), landmarks, '{}', LISTENER);
    flows = recordFlows(demo.source(), demo.target(), landmarks, output.cones(), 'inversive', LISTENER);
    stages = recordSimplifications(demo.source(), demo.target(), landmarks, LISTENER);
    vertices = new TextDecoder().decode(demo.source()).match(/^v /gm)?.length ?? 0;
    // A map is made first, possibly on a busy machine.
  }, 120_000);

  test('are those of its report, step by step', () => {
    const { cone_metric: told } = JSON.parse(output.report()) as Report;
    for (const [side, report] of [told.source, told.target].entries()) {
      const { moments, converged } = JSON.parse(flows.steps(side)) as SideFlow;
      expect(converged).toBe(true);
      expect(moments.map(({ residual }) => residual)).toEqual(report?.residuals);
      expect(moments.at(-1)).toMatchObject({ step: report?.newton_steps, cgIterations: report?.cg_iterations, edgeFlips: report?.edge_flips });
    }
  });

  test('begin at rest, and have a factor for each vertex of the mesh', () => {
    const factors = flows.logFactors(0);
    const { moments } = JSON.parse(flows.steps(0)) as SideFlow;
    expect(vertices).toBeGreaterThan(100);
    expect(factors.length).toBe(vertices * moments.length);
    expect(factors.subarray(0, vertices).every((factor) => factor === 0)).toBe(true);
    const last = factors.subarray(factors.length - vertices);
    expect(Math.max(...last)).toBeGreaterThan(0.1);
    expect(Math.min(...last)).toBeLessThan(0);
  });

  test('have a simplification that ends at the base domain', () => {
    const { base_domain: base } = JSON.parse(output.report()) as Report;
    const found: Simplification = { positions: stages.positions(0), triangles: stages.triangles(0), counts: stages.counts(0), collapses: stages.collapses(0) };
    expect(found.positions.length).toBe(3 * vertices);
    expect(found.counts[0]).toBe(2 * vertices - 4);
    expect(found.counts.at(-1)).toBe(base.faces);
    expect(found.triangles.length).toBe(3 * found.counts.reduce((sum, count) => sum + count, 0));
    expect(new Set(stageAt(found, 1, 1).triangles).size).toBe(base.vertices);
    // All vertices except those of the base domain are removed, each by a collapse onto one of these.
    expect(found.collapses.length).toBe(2 * (vertices - base.vertices));
    const corners = new Set(stageAt(found, 1, 1).triangles);
    for (let vertex = 0; vertex < vertices; vertex++) {
      const history = historyOf(found, vertex);
      expect(corners.has(history.at(-1)?.vertex ?? vertex)).toBe(true);
      expect(history.length === 0).toBe(corners.has(vertex));
    }
  });

  test('refuse curvatures that no closed surface has', () => {
    const demo = buildDemo('sphere-tetrahedron');
    const landmarks = new TextDecoder().decode(demo?.landmarks());
    const wrong = output.cones().map((cone) => cone / 2);
    expect(() => recordFlows(demo?.source() ?? new Uint8Array(), demo?.target() ?? new Uint8Array(), landmarks, wrong, 'inversive', LISTENER)).toThrow(/4 pi/);
  });

  test('go by every structure, and without flips stop at triangles that are told and can be shown', () => {
    const [source, target] = [rod(8), rod(1)].map((text) => new TextEncoder().encode(text));
    const cones = new Float64Array(4).fill(Math.PI);
    const stopped = wordsOf(STRUCTURES).filter((scheme) => {
      const found = recordFlows(source ?? new Uint8Array(), target ?? new Uint8Array(), CORNERS, cones, scheme, LISTENER);
      const { converged, stops } = JSON.parse(found.steps(0)) as SideFlow;
      const shown = unpackDefects(found.packedStops(0));
      const [group] = JSON.parse(shown.list()) as DefectGroup[];
      expect(group?.count ?? 0, scheme).toBe(stops.length);
      expect(shown.faceCount).toBe(stops.length);
      expect(stops.length === 0, scheme).toBe(converged);
      expect(stops.every((face) => face >= 0 && face < 1024)).toBe(true);
      if (!converged) {
        expect(group?.sentence).toMatch(/stops? the flow$/);
      }
      return !converged;
    });
    expect(stopped).toEqual(['fixed-triangulation']);
    expect(() => recordFlows(source ?? new Uint8Array(), target ?? new Uint8Array(), CORNERS, cones, 'none', LISTENER)).toThrow(/none/);
  });

  test('have ten colours, the lightest in the middle', () => {
    const colours = factorScale();
    expect(colours.length).toBe(30);
    const light = Array.from({ length: 10 }, (_, k) => (colours[3 * k] ?? 0) + (colours[3 * k + 1] ?? 0) + (colours[3 * k + 2] ?? 0));
    expect([4, 5]).toContain(light.indexOf(Math.max(...light)));
  });
});

function moment(step: number, residual: number): SideFlow['moments'][number] {
  return { step, residual, cgIterations: 10 * step, edgeFlips: 3 * step };
}

const LN2 = Math.LN2;
/** The fields of a flow that no triangle has stopped. */
const RESTING = { stops: [], packedStops: new Uint8Array(), radii: new Float32Array([0.1, 0.2]), curvatures: [new Float32Array(2), new Float32Array(2)] } as const;
/** Both meshes have two vertices; the target's flow ends after one step. */
const FLOWS: Flows = [
  { ...RESTING, moments: [moment(0, 1), moment(1, 0.02), moment(2, 1e-9)], converged: true, logFactors: new Float32Array([0, 0, LN2, -LN2, 2 * LN2, -2.5 * LN2]) },
  { ...RESTING, moments: [moment(0, 0.5), moment(1, 0)], converged: false, logFactors: new Float32Array([0, 0, 0.1, -0.1]) },
];

describe('the scale', () => {
  test('ends at a power of 2 that holds the factors of both meshes', () => {
    expect(scaleEnd(FLOWS)).toBe(8);
    expect(scaleEnd([FLOWS[1], FLOWS[1]])).toBe(2);
  });

  test('is even in the logarithm, with 1 in its middle', () => {
    expect([-3 * LN2, 0, 3 * LN2].map((factor) => placeOf(factor, 8))).toEqual([0, 0.5, 1]);
  });

  test('is gone along from moment to moment, and a flow that has ended stays', () => {
    expect(momentCount(FLOWS)).toBe(3);
    const [source, target] = placesAt(FLOWS, 1, 2);
    [1, 0].forEach((place, v) => { expect(source.from[v]).toBeCloseTo(place, 6); });
    [1.5, -0.75].forEach((place, v) => { expect(source.to[v]).toBeCloseTo(place, 6); });
    expect(target.from).toEqual(target.to);
    expect(placesAt(FLOWS, 2, 2)[0].from).toEqual(placesAt(FLOWS, 2, 2)[0].to);
    // The circles grow with the conformal factor.
    const [radii] = radiiAt(FLOWS, 1) ?? [];
    expect([...(radii ?? [])].map((radius) => Math.round(1000 * radius) / 1000)).toEqual([0.2, 0.1]);
    expect(radiiAt([FLOWS[0], { ...FLOWS[1], radii: new Float32Array() }], 1)).toBeNull();
  });
});

describe('the numbers', () => {
  test('are those of the moment, or of the last', () => {
    expect(momentAt(FLOWS[0], 1).cgIterations).toBe(10);
    expect(momentAt(FLOWS[1], 2).step).toBe(1);
    expect(residualRange(FLOWS)).toEqual([1e-9, 1]);
  });

  test('are a table', () => {
    expect(flowCsv(FLOWS).split('\n')).toEqual([
      'mesh,Newton step,largest curvature error (rad),CG iterations,edge flips',
      'source,0,1,0,0',
      'source,1,0.02,10,3',
      'source,2,1e-9,20,6',
      'target,0,0.5,0,0',
      'target,1,0,10,3',
      '',
    ]);
  });
});

describe('the stages', () => {
  const stages = (...counts: readonly number[]): Simplification => ({
    positions: new Float32Array(),
    triangles: Uint32Array.from({ length: 3 * counts.reduce((sum, count) => sum + count, 0) }, (_, k) => k),
    counts: Uint32Array.from(counts),
    collapses: new Uint32Array(),
  });

  test('of both meshes begin and end together', () => {
    const [long, short] = [stages(9, 7, 6, 5, 4), stages(8, 6, 4)];
    expect(stageCount([long, short])).toBe(5);
    expect([0, 1, 2, 3, 4].map((stage) => countAt(long, stage, 4))).toEqual([9, 7, 6, 5, 4]);
    expect([0, 1, 2, 3, 4].map((stage) => countAt(short, stage, 4))).toEqual([8, 6, 6, 4, 4]);
    expect(countAt(short, 0, 0)).toBe(8);
  });

  test('are their own triangles', () => {
    const found = stages(3, 2, 1);
    expect([...stageAt(found, 1, 2).triangles]).toEqual([9, 10, 11, 12, 13, 14]);
    expect([...stageAt(found, 2, 2).triangles]).toEqual([15, 16, 17]);
  });

  test('have a history of each vertex, from place to place to one that stays', () => {
    const found: Simplification = { ...stages(4), positions: Float32Array.from([0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0]), collapses: Uint32Array.from([0, 1, 3, 2, 1, 2]) };
    expect(nearestVertex(found, [0.6, 0.1, -0.2])).toBe(1);
    expect(historyOf(found, 0)).toEqual([
      { vertex: 1, collapse: 1 },
      { vertex: 2, collapse: 3 },
    ]);
    expect([...trailOf(found, 0, historyOf(found, 0))]).toEqual([0, 0, 0, 1, 0, 0, 2, 0, 0]);
    expect(historyOf(found, 2)).toEqual([]);
    expect([...trailOf(found, 2, [])]).toEqual([2, 0, 0]);
  });
});
