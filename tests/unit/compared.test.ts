/** The comparison of the map on the page with another one: how it begins, goes on and ends, and the figures of both maps. */
import { beforeAll, describe, expect, test } from 'vitest';
import { Comparer } from '../../www/app/compare.ts';
import type { OtherOutput } from '../../www/compute/watch-messages.ts';
import { figuresOf } from '../../www/method/compared-figures.ts';
import type { Report } from '../../www/report.ts';
import { change } from '../../www/store/change.ts';
import { otherMap, shownStyle } from '../../www/store/compared.ts';
import type { ComparedMap, State, Style } from '../../www/store/state.ts';
import { Store } from '../../www/store/store.ts';
import type { MapOutput } from '../../www/wasm/core.js';
import { buildDemo, runOtherMap } from '../../www/wasm/core.js';
import { DONE, READY, REPORT, RUNNING } from './fixtures.ts';
import { startCoreModule } from './modules.ts';

const METHOD: State = { ...DONE, ui: { ...DONE.ui, step: 'method' } };
const COMPUTING = change(METHOD, [{ kind: 'comparison-begun', which: 'start' }]);
const MAP: ComparedMap = { output: { distortion: new Float32Array(), truth: new Float32Array() } as OtherOutput, report: REPORT };
const THERE = change(COMPUTING, [{ kind: 'comparison', which: 'start', progress: { kind: 'there', map: MAP } }]);

describe('a comparison', () => {
  test('begins with the map on the page, and where there is none not at all', () => {
    expect(COMPUTING.comparison).toEqual({ of: DONE.result, which: 'start', progress: { kind: 'computing', share: 0 } });
    const empty = { ...READY, ui: METHOD.ui };
    expect(change(empty, [{ kind: 'comparison-begun', which: 'start' }])).toBe(empty);
    const running: State = { ...METHOD, job: RUNNING };
    expect(change(running, [{ kind: 'comparison-begun', which: 'start' }]).comparison).toBeNull();
  });

  test('is shown when the other map has come, and hears nothing of another one', () => {
    expect(otherMap(COMPUTING)).toBeNull();
    expect(otherMap(THERE)).toBe(MAP);
    const late = { kind: 'comparison', which: 'patchwise', progress: { kind: 'there', map: MAP } } as const;
    expect(change(COMPUTING, [late])).toBe(COMPUTING);
    expect(change(METHOD, [late])).toBe(METHOD);
  });

  test('gives way to the next one', () => {
    const next = change(THERE, [{ kind: 'comparison-begun', which: 'equal-cones' }]);
    expect(next.comparison).toMatchObject({ which: 'equal-cones', progress: { kind: 'computing' } });
    expect(otherMap(next)).toBeNull();
  });

  test('ends when it is closed, another step is opened, another map is made, or the meshes are exchanged', () => {
    expect(change(THERE, [{ kind: 'comparison-closed' }]).comparison).toBeNull();
    expect(change(THERE, [{ kind: 'ui', ui: { step: 'map' } }]).comparison).toBeNull();
    expect(change(THERE, [{ kind: 'run-started' }]).comparison).toBeNull();
    expect(change(THERE, [{ kind: 'swap-meshes' }]).comparison).toBeNull();
    // The user may fold the panel to see more of the views.
    expect(change(THERE, [{ kind: 'ui', ui: { panel: 'folded' } }]).comparison).toBe(THERE.comparison);
  });

  test('changes neither the work nor its steps nor the map', () => {
    for (const state of [COMPUTING, THERE, change(THERE, [{ kind: 'comparison-closed' }])]) {
      expect({ ...state, comparison: null }).toEqual(METHOD);
      expect([state.history, state.result]).toEqual([METHOD.history, METHOD.result]);
    }
  });
});

describe('the views', () => {
  const seen = (state: State, style: Partial<Style>): Style => shownStyle({ ...state, ui: { ...state.ui, style: { ...state.ui.style, ...style } } });

  test('look as they are asked to without another map', () => {
    expect(shownStyle(METHOD)).toBe(METHOD.ui.style);
    expect(shownStyle(COMPUTING)).toBe(METHOD.ui.style);
  });

  test('show of two maps what both carry, in the shape of the source', () => {
    expect(seen(THERE, { surface: 'checkerboard' }).surface).toBe('checkerboard');
    for (const surface of ['shaded', 'look', 'distortion', 'truth'] as const) {
      expect(seen(THERE, { surface }).surface).toBe('pattern');
    }
    expect(seen(THERE, { morph: 0.5, wipe: 0.5, patchLines: true })).toMatchObject({ morph: 0, wipe: null, patchLines: true });
  });
});

test('nothing is compared without a core and a map', () => {
  const store = new Store();
  for (const core of [null, new Promise<WebAssembly.Module>(() => undefined)]) {
    const comparer = new Comparer(store, () => core);
    comparer.choose('patchwise');
    expect(store.state.comparison).toBeNull();
    comparer.choose(null);
  }
  expect(store.state).toBe(new Store().state);
});

describe('the figures', () => {
  const flow = { newton_steps: 6, cg_iterations: 60, edge_flips: 5, max_curvature_error: 1e-9, residuals: [], seconds: 0 };
  const report = {
    distortion: { energy: 4.5712, mean_log: 0.0625, l2_stretch: 1.832 },
    unmapped_share: 0.0016,
    cone_metric: { source: flow, target: { ...flow, newton_steps: 5 } },
    warnings: [],
  } as unknown as Report;
  const values = (of: Report): readonly string[] => figuresOf(of).map(({ value }) => value);

  test('are those of the report', () => {
    expect(values(report)).toEqual(['4.571', '0.0625', '1.832', '99.84 %', '6, 5', 'yes']);
  });

  test('tell flows that failed', () => {
    const failed = {
      ...report,
      distortion: { ...report.distortion, l2_stretch: null },
      cone_metric: { source: flow, target: null },
      warnings: [{ kind: 'no_cone_metric' }],
    } as unknown as Report;
    expect(values(failed).slice(2)).toEqual(['–', '99.84 %', '6, –', 'no']);
  });
});

describe('another map', () => {
  const nothing = (): void => undefined;
  const LISTENER = { relaxes: nothing, progress: nothing, preview: nothing, found: nothing, wantsResult: (): boolean => false };

  function made(which: string): MapOutput {
    const demo = buildDemo('sphere-tetrahedron');
    if (demo === undefined) {
      throw new Error('no demo');
    }
    return runOtherMap(demo.source(), demo.target(), new TextDecoder().decode(demo.landmarks()), '{}', which, LISTENER);
  }

  beforeAll(() => {
    startCoreModule();
  });

  test('is certified where it is the one that relaxation begins with, and has no files', () => {
    const output = made('start');
    const { certificate, own_landmarks: own } = JSON.parse(output.report()) as Report;
    expect([certificate?.bijective, certificate?.flipped_triangles, own]).toEqual([true, 0, 0]);
    expect(output.positions(0).length).toBe(output.positions(1).length);
    expect(() => output.mapFile()).toThrow(/export/);
  }, 120_000);

  test('is certified and whole where each patch is straight', () => {
    const { certificate, unmapped_share: unmapped, distortion, warnings } = JSON.parse(made('tutte').report()) as Report;
    expect([certificate?.bijective, certificate?.flipped_triangles, unmapped, warnings]).toEqual([true, 0, 0, []]);
    expect(distortion.energy).toBeGreaterThan((JSON.parse(made('start').report()) as Report).distortion.energy);
  }, 120_000);

  test('is of the thesis where cones are named', () => {
    for (const which of ['equal-cones', 'patchwise']) {
      const { certificate, warnings } = JSON.parse(made(which).report()) as Report;
      expect(certificate).toBeNull();
      expect(warnings.map(({ kind }) => kind)).toContain('no_bijection');
    }
  }, 120_000);

  test('is none where nobody knows its name', () => {
    expect(() => made('harmonic')).toThrow(/options/);
  });
});
