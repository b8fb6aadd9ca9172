/** What the views show. */
import { byId, button, make } from '../dom.ts';
import { shownResult } from '../store/staleness.ts';
import type { State, Style } from '../store/state.ts';
import type { Actions, Panel } from './panel.ts';

const SURFACES: readonly (readonly [Style['surface'], string])[] = [
  ['shaded', 'Shaded'],
  ['checkerboard', 'Checkerboard'],
  ['colours', 'Colours'],
  ['distortion', 'Distortion'],
];
const TOGGLES = [
  ['markers', 'Landmarks'],
  ['cones', 'Cones'],
  ['patchLines', 'Patch lines'],
] as const;

/** Makes the panel. */
export function displayPanel(actions: Actions, resetViews: () => void): Panel {
  const root = byId('display');
  const radios = SURFACES.map(([value, text]) => {
    const input = make('input', { type: 'radio', name: 'surface', value });
    input.addEventListener('change', () => {
      actions.dispatch({ kind: 'style', style: { surface: value } });
    });
    return { value, input, label: make('label', { class: 'choice' }, input, make('span', {}, text)) };
  });
  const toggles = TOGGLES.map(([key, text]) => {
    const input = make('input', { type: 'checkbox', name: key });
    input.addEventListener('change', () => {
      actions.dispatch({ kind: 'style', style: { [key]: input.checked } });
    });
    return { key, input, label: make('label', { class: 'choice' }, input, make('span', {}, text)) };
  });
  const legend = make(
    'p',
    { class: 'quiet legend' },
    make('span', { class: 'dot positive', 'aria-hidden': 'true' }),
    'positive and ',
    make('span', { class: 'dot negative', 'aria-hidden': 'true' }),
    'negative cone curvature',
  );
  const scale = make(
    'div',
    { class: 'scale', role: 'img', 'aria-label': 'Colours of the distortion from 1, which is none, to 4 and more' },
    make('div', { class: 'bar' }),
    make('div', { class: 'ticks' }, make('span', {}, '1, none'), make('span', {}, '2'), make('span', {}, '4 and more')),
  );
  root.append(
    make('h2', {}, 'Display'),
    make('div', { class: 'segments', role: 'radiogroup', 'aria-label': 'Surface' }, ...radios.map((radio) => radio.label)),
    make('div', { class: 'row checks' }, ...toggles.map((toggle) => toggle.label)),
    scale,
    legend,
    button('Reset views', resetViews, { class: 'plain' }),
  );
  return {
    render(state: State): void {
      const result = shownResult(state);
      const { style } = state.ui;
      const surface = result === null ? 'shaded' : style.surface;
      for (const { value, input } of radios) {
        input.checked = surface === value;
        input.disabled =
          value !== 'shaded' && (result === null || (value === 'distortion' && result.output.distortion.length === 0));
      }
      for (const { key, input } of toggles) {
        input.checked = style[key];
        input.disabled = key !== 'markers' && result === null;
      }
      scale.hidden = surface !== 'distortion';
      legend.hidden = result === null || !style.cones;
    },
  };
}
