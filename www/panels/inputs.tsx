/** The file choosers; buttons anywhere on the page open them. */
import type { VNode } from 'preact';
import { byId } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { MAP_ENDING } from '../map-files.ts';
import { PART_ENDINGS } from '../mesh-sets.ts';
import type { State } from '../store/state.ts';
import { landmarkEndings, meshEndings } from '../wasm/page.js';
import type { Actions } from './actions.ts';

export type Chooser = 'mesh-files' | 'source-file' | 'target-file' | 'landmark-file' | 'landmarks-of-source' | 'landmarks-of-target' | 'texture-file';

/** Opens a chooser. */
export function choose(chooser: Chooser): void {
  byId(chooser).click();
}

interface ChooserProps {
  readonly id: Chooser;
  readonly accept: string;
  readonly onFiles: (files: File[]) => void;
}

function FileInput({ id, accept, onFiles }: ChooserProps): VNode {
  return (
    <input
      type="file"
      id={id}
      accept={accept}
      multiple
      hidden
      tabIndex={-1}
      aria-hidden="true"
      onChange={(event) => {
        const files = [...(event.currentTarget.files ?? [])];
        event.currentTarget.value = '';
        if (files.length > 0) {
          onFiles(files);
        }
      }}
    />
  );
}

/**
 * The endings that each kind of file chooser offers, as the core and the page read them. Files that are dropped on the page are recognised
 * by their content alone.
 */
function accepted(): { readonly meshes: string; readonly landmarks: string; readonly all: string } {
  const landmarks = landmarkEndings();
  const meshes = [meshEndings(), PART_ENDINGS].join(',');
  return { meshes, landmarks, all: [meshes, landmarks, MAP_ENDING].join(',') };
}

const NOTHING_YET: ReturnType<typeof accepted> = { meshes: '', landmarks: '', all: '' };

/** All file choosers. What they accept is known once the page's module is loaded. */
export function FileInputs({ state, actions }: { readonly state: State; readonly actions: Actions }): VNode {
  const { meshes, landmarks, all } = state.ready ? accepted() : NOTHING_YET;
  const open = (side: Side | null) => (files: File[]): void => {
    actions.openFiles(files, side);
  };
  return (
    <>
      <FileInput id="mesh-files" accept={all} onFiles={open(null)} />
      <FileInput id="source-file" accept={meshes} onFiles={open(0)} />
      <FileInput id="target-file" accept={meshes} onFiles={open(1)} />
      <FileInput id="landmark-file" accept={landmarks} onFiles={open(null)} />
      <FileInput id="landmarks-of-source" accept={landmarks} onFiles={open(0)} />
      <FileInput id="landmarks-of-target" accept={landmarks} onFiles={open(1)} />
      <FileInput
        id="texture-file"
        accept="image/png, image/jpeg, image/webp"
        onFiles={(files) => {
          files.slice(0, 1).forEach(actions.openTexturePicture);
        }}
      />
    </>
  );
}
