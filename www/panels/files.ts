/** Files and demos: buttons, the menu, and dropping anywhere on the page. */
import { byId, button, make } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { integer } from '../numbers.ts';
import type { State } from '../store/state.ts';
import { meshEndings, meshFormats } from '../wasm/conemap.js';
import type { Actions, Panel } from './panel.ts';

const NAMES = ['Source', 'Target'] as const;

function chooser(accept: string, onFiles: (files: File[]) => void): HTMLInputElement {
  const input = make('input', { type: 'file', accept, hidden: true, tabindex: -1 });
  input.addEventListener('change', () => {
    const files = [...(input.files ?? [])];
    input.value = '';
    if (files.length > 0) {
      onFiles(files);
    }
  });
  return input;
}

/** Which view lies under a point of the window. */
function sideAt(x: number, y: number): Side | null {
  for (const side of SIDES) {
    const box = byId(side === 0 ? 'view-source' : 'view-target').getBoundingClientRect();
    if (x >= box.left && x < box.right && y >= box.top && y < box.bottom) {
      return side;
    }
  }
  return null;
}

function acceptDrops(actions: Actions): void {
  const veil = byId('drop-veil');
  const sentence = make('p', {}, 'Drop one or two meshes and a landmark file');
  const halves = SIDES.map((side) => make('div', { class: 'half' }, NAMES[side]));
  veil.append(...halves, sentence);
  const hide = (): void => {
    veil.hidden = true;
  };
  window.addEventListener('dragover', (event) => {
    event.preventDefault();
    if (event.dataTransfer?.types.includes('Files') !== true) {
      return;
    }
    veil.hidden = false;
    const side = sideAt(event.clientX, event.clientY);
    halves.forEach((half, index) => half.classList.toggle('over', index === side));
  });
  window.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) {
      hide();
    }
  });
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    hide();
    const files = event.dataTransfer === null ? [] : [...event.dataTransfer.files];
    if (files.length > 0) {
      actions.openFiles(files, sideAt(event.clientX, event.clientY));
    }
  });
}

/** Makes the panel in the page's header. */
export function filesPanel(actions: Actions): Panel {
  const root = byId('files');
  const select = make('select', { id: 'demo-select', 'aria-label': 'Demo' }, make('option', { value: '' }, 'Demos'));
  select.addEventListener('change', () => {
    if (select.value !== '') {
      actions.openDemo(select.value);
    }
  });
  const meshButtons = SIDES.map((side) => {
    // What is accepted is known when the core is there.
    const input = chooser('', (files) => {
      actions.openFiles(files.slice(0, 1), side);
    });
    input.id = side === 0 ? 'source-file' : 'target-file';
    const choose = button(`${NAMES[side]}…`, () => {
      input.click();
    });
    root.append(choose, input);
    return { choose, input };
  });
  const landmarkInput = chooser('.json', (files) => {
    actions.openFiles(files.slice(0, 1), null);
  });
  landmarkInput.id = 'landmark-file';
  const landmarkButton = button('Landmarks…', () => {
    landmarkInput.click();
  }, { title: 'Choose a landmark file (JSON)' });
  root.append(landmarkButton, landmarkInput);
  root.prepend(select);
  acceptDrops(actions);

  const captions = SIDES.map((side) => {
    const caption = make('p', { class: 'caption' });
    byId(side === 0 ? 'view-source' : 'view-target').append(caption);
    return caption;
  });

  return {
    render(state: State, previous: State | null): void {
      if (previous?.demos !== state.demos) {
        select.replaceChildren(
          make('option', { value: '' }, 'Demos'),
          ...state.demos.map((demo) => make('option', { value: demo.id, title: demo.sentence }, demo.title)),
        );
      }
      if (previous?.demo !== state.demo || previous.demos !== state.demos) {
        select.value = state.demo?.id ?? '';
      }
      const running = state.job.kind === 'running';
      if (state.ready && previous?.ready !== true) {
        meshButtons.forEach(({ choose, input }, side) => {
          input.accept = meshEndings();
          choose.title = `Choose the ${NAMES[side]?.toLowerCase()} mesh: ${meshFormats()}`;
        });
      }
      for (const element of [select, landmarkButton, ...meshButtons.map(({ choose }) => choose)]) {
        element.disabled = !state.ready || running;
      }
      if (previous?.meshes !== state.meshes) {
        for (const side of SIDES) {
          const caption = captions[side];
          const file = state.meshes[side];
          const facts =
            file === null
              ? ['drop a mesh here']
              : [file.name, ' ', make('small', {}, `${integer(file.faceCount)} triangles${turned(file.turnedFaces)}`)];
          caption?.replaceChildren(make('strong', {}, NAMES[side]), ' ', ...facts);
        }
      }
    },
  };
}

function turned(count: number): string {
  return count === 0 ? '' : `, ${integer(count)} turned to look outwards`;
}
