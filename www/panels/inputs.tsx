/** The file choosers; buttons anywhere on the page open them. */
import type { VNode } from 'preact';
import { byId } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import type { State } from '../store/state.ts';
import { meshEndings } from '../wasm/conemap.js';
import type { Actions } from './actions.ts';

export type Chooser = 'mesh-files' | 'source-file' | 'target-file' | 'landmark-file';

/** Opens a chooser. */
export function choose(chooser: Chooser): void {
  byId(chooser).click();
}

interface ChooserProps {
  readonly id: Chooser;
  readonly accept: string;
  readonly multiple?: boolean;
  readonly onFiles: (files: File[]) => void;
}

function FileInput({ id, accept, multiple, onFiles }: ChooserProps): VNode {
  return (
    <input
      type="file"
      id={id}
      accept={accept}
      multiple={multiple}
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

/** All of them. What is accepted is known when the core is there. */
export function FileInputs({ state, actions }: { readonly state: State; readonly actions: Actions }): VNode {
  const meshes = state.ready ? meshEndings() : '';
  const open = (side: Side | null) => (files: File[]): void => {
    actions.openFiles(files, side);
  };
  return (
    <>
      <FileInput id="mesh-files" accept={meshes === '' ? '' : `${meshes},.json,.zip`} multiple onFiles={open(null)} />
      <FileInput id="source-file" accept={meshes} onFiles={open(0)} />
      <FileInput id="target-file" accept={meshes} onFiles={open(1)} />
      <FileInput id="landmark-file" accept=".json" onFiles={open(null)} />
    </>
  );
}
