/** The files that can be saved: those of the result, and the landmarks. */
import type { MadeFiles } from '../compute/messages.ts';
import { download } from '../dom.ts';
import { wholePairs } from '../store/order.ts';
import { shownResult } from '../store/staleness.ts';
import type { Result, State } from '../store/state.ts';
import type { Actions } from './actions.ts';

export interface Export {
  /** The format, which the button shows. */
  readonly format: string;
  readonly title: string;
  readonly about: string;
  readonly save: () => void;
}

type Saving = Pick<Actions, 'saveMadeFile' | 'saveWrapped' | 'saveLandmarks'>;

/** A file of a map. */
interface MapExport extends Omit<Export, 'save'> {
  /** The name under which it is saved. */
  readonly name: string;
  readonly type: string;
  /** The core's name for it, by which the core makes it from a map file. */
  readonly made: string;
  /** The field of `MadeFiles` for a map that has no map file; `null` where such a map does not have this file. */
  readonly key: keyof MadeFiles | null;
}

const GLB = 'model/gltf-binary';
const OBJ = 'model/obj';

/** The core's name of the file that a map to a mirror image does not have: a mesh cannot turn into its mirror image. */
const MORPH = 'source-to-target.glb';

/** The files of a map, the most wanted first. */
export const MAP_EXPORTS: readonly MapExport[] = [
  { format: 'GLB', title: 'Textured mesh', about: 'The source with the target’s own colours and pictures, or with a checkerboard', name: 'conemap.glb', type: GLB, made: 'source-with-target-texture.glb', key: 'glb' },
  { format: 'Morph', title: 'Animated mesh', about: 'The source on its way to the target’s shape: limbs turn instead of shrinking', name: 'morph.glb', type: GLB, made: MORPH, key: null },
  { format: 'CSV', title: 'Images of the vertices', about: 'Where every vertex of the source lies on the target', name: 'conemap.csv', type: 'text/csv', made: 'vertex-images.csv', key: 'csv' },
  { format: 'Base OBJ', title: 'Base domain', about: 'The coarse mesh between the landmarks', name: 'base-domain.obj', type: OBJ, made: 'base-domain.obj', key: 'baseObj' },
  { format: 'Inverse table', title: 'Images of the target’s vertices', about: 'Where on the source every vertex of the target comes from', name: 'target-vertex-images.csv', type: 'text/csv', made: 'target-vertex-images.csv', key: null },
  { format: 'Source shape', title: 'Source in the target’s shape', about: 'The source’s polygons, with its vertices at their images', name: 'source-in-target-shape.obj', type: OBJ, made: 'source-in-target-shape.obj', key: null },
  { format: 'Target shape', title: 'Target in the source’s shape', about: 'The target’s polygons, the other way round', name: 'target-in-source-shape.obj', type: OBJ, made: 'target-in-source-shape.obj', key: null },
  { format: 'Layout', title: 'Flat layout', about: 'Both meshes cut open on the flat base domain, as a drawing', name: 'layout.svg', type: 'image/svg+xml', made: 'layout.svg', key: null },
];

/** A file of a map, which is there already or is made when it is asked for; `null` where the map has no such file. */
function exportOf({ output, opened }: Result, { key, made, name, type, ...shown }: MapExport, { saveMadeFile }: Saving): Export | null {
  if (made === MORPH && opened?.isMirrored === true) {
    return null;
  }
  const data = key === null ? null : (output.made?.[key] ?? null);
  if (data !== null) {
    return {
      ...shown,
      save: () => {
        download(name, type, data);
      },
    };
  }
  return output.map === null
    ? null
    : {
        ...shown,
        save: () => {
          saveMadeFile({ made, name, type });
        },
      };
}

/** The source laid onto the target; empty where the map has no map file, or goes to the target's mirror image. */
function wrapped({ output, opened }: Result, { saveWrapped }: Saving): readonly Export[] {
  if (output.map === null || opened?.isMirrored === true) {
    return [];
  }
  const about = 'Your source’s own OBJ or OFF file: polygons, texture coordinates and order kept, every vertex fitted to the target';
  return [{ format: 'Wrapped', title: 'Source wrapped onto the target', about, save: saveWrapped }];
}

function reportAndMap({ output }: Result): readonly Export[] {
  const { map, report } = output;
  const numbers = {
    format: 'Report',
    title: 'All numbers',
    about: 'Quality, certificate and times as JSON',
    save: () => {
      download('report.json', 'application/json', report);
    },
  };
  const itself = {
    format: 'Map file',
    title: 'The map itself',
    about: 'Every piece in full; drop it on the page with its meshes to have the map again',
    save: () => {
      download('map.conemap', 'application/octet-stream', map ?? '');
    },
  };
  return map === null ? [numbers] : [numbers, itself];
}

/** The files that can be saved now, the most wanted first. */
export function exportsOf(state: State, saving: Saving): readonly Export[] {
  const result = shownResult(state);
  const files = result === null ? [] : [...MAP_EXPORTS.flatMap((file) => exportOf(result, file, saving) ?? []), ...wrapped(result, saving), ...reportAndMap(result)];
  const landmarks = {
    format: 'JSON',
    title: 'Landmarks',
    about: 'All pairs with their names, to be opened again; other formats are in the step Landmarks',
    save: () => {
      saving.saveLandmarks();
    },
  };
  return wholePairs(state).length === 0 ? files : [...files, landmarks];
}
