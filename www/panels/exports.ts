/** What can be taken away: the files of the result, and the landmarks. */
import { download } from '../dom.ts';
import { wholePairs } from '../store/order.ts';
import type { State } from '../store/state.ts';
import type { Actions } from './actions.ts';

export interface Export {
  /** The format, on the button. */
  readonly format: string;
  readonly title: string;
  readonly about: string;
  readonly save: () => void;
}

/** Files that the core makes of a map file when they are asked for: format, title, what it is, name and type. */
const MADE = [
  ['Inverse table', 'Images of the target’s vertices', 'Where on the source every vertex of the target comes from', 'target-vertex-images.csv', 'text/csv'],
  ['Source shape', 'Source in the target’s shape', 'The source’s polygons, with its vertices at their images', 'source-in-target-shape.obj', 'model/obj'],
  ['Target shape', 'Target in the source’s shape', 'The target’s polygons, the other way round', 'target-in-source-shape.obj', 'model/obj'],
  ['Layout', 'Flat layout', 'Both meshes cut open on the flat base domain, as a drawing', 'layout.svg', 'image/svg+xml'],
] as const;

/** The map file and what is made of it; none where the map has no such file. */
function ofMapFile({ result }: State, saveMadeFile: Actions['saveMadeFile']): readonly Export[] {
  const map = result?.output.map ?? null;
  if (map === null) {
    return [];
  }
  const made = MADE.map(([format, title, about, name, type]) => ({
    format,
    title,
    about,
    save: () => {
      saveMadeFile(name, type);
    },
  }));
  const itself = {
    format: 'Map file',
    title: 'The map itself',
    about: 'Every piece in full; conemap query, report and export read it',
    save: () => {
      download('map.conemap', 'application/octet-stream', map);
    },
  };
  return [...made, itself];
}

/** The files that there are now, the most wanted first. */
export function exportsOf(state: State, { saveMadeFile, saveLandmarks }: Pick<Actions, 'saveMadeFile' | 'saveLandmarks'>): readonly Export[] {
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
    about: 'All pairs with their names, to be opened again; other formats are in the step Landmarks',
    save: () => {
      saveLandmarks();
    },
  };
  const all = [...files, ...ofMapFile(state, saveMadeFile)];
  return wholePairs(state).length === 0 ? all : [...all, landmarks];
}
