/** What can be taken away: the files of the result, and the landmarks. */
import { download } from '../dom.ts';
import { landmarkFileOf } from '../store/landmark-file.ts';
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';

export interface Export {
  /** The format, on the button. */
  readonly format: string;
  readonly title: string;
  readonly about: string;
  readonly save: () => void;
}

/** Saves the landmarks as a file. */
export function saveLandmarks(state: State): void {
  download('landmarks.json', 'application/json', JSON.stringify(landmarkFileOf(state), null, 1));
}

/** The files that there are now, the most wanted first. */
export function exportsOf(state: State): readonly Export[] {
  const { result } = state;
  const ofResult =
    result === null
      ? []
      : ([
          ['GLB', 'Textured mesh', 'The source with the texture of the target', 'conemap.glb', 'model/gltf-binary', result.output.glb],
          ['CSV', 'Images of the vertices', 'Where every vertex of the source lies on the target', 'conemap.csv', 'text/csv', result.output.csv],
          ['Report', 'All numbers', 'Quality, certificate and times as JSON', 'report.json', 'application/json', result.output.report],
          ['Base OBJ', 'Base domain', 'The coarse mesh between the landmarks', 'base-domain.obj', 'model/obj', result.output.baseObj],
        ] as const);
  const files = ofResult.map(([format, title, about, name, type, data]) => ({
    format,
    title,
    about,
    save: () => {
      download(name, type, data);
    },
  }));
  const landmarks = {
    format: 'JSON',
    title: 'Landmarks',
    about: 'All pairs with their names, to be opened again',
    save: () => {
      saveLandmarks(state);
    },
  };
  return wholePairs(state).length === 0 ? files : [...files, landmarks];
}
