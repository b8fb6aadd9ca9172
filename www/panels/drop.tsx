/** Files dropped anywhere on the page, or pasted. */
import type { VNode } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { byId, folderAmong } from '../dom.ts';
import type { Side } from '../landmarks.ts';
import { SIDES } from '../landmarks.ts';
import { SENTENCES } from '../messages.ts';
import type { Actions } from './actions.ts';
import { VIEW_IDS } from './names.ts';

/** The side of the view under a point of the window; `null` for none. */
function sideAt(x: number, y: number): Side | null {
  for (const side of SIDES) {
    const box = byId(VIEW_IDS[side]).getBoundingClientRect();
    if (x >= box.left && x < box.right && y >= box.top && y < box.bottom) {
      return side;
    }
  }
  return null;
}

/** What is dragged over the page: `null` for nothing, else the side of the view under it. */
type Over = { readonly side: Side | null } | null;

function listen(actions: Actions, show: (over: Over) => void): () => void {
  // A part of the page that takes files itself prevents the event's default.
  const over = (event: DragEvent): void => {
    if (event.defaultPrevented) {
      show(null);
      return;
    }
    event.preventDefault();
    if (event.dataTransfer?.types.includes('Files') === true) {
      show({ side: sideAt(event.clientX, event.clientY) });
    }
  };
  const leave = (event: DragEvent): void => {
    if (event.relatedTarget === null) {
      show(null);
    }
  };
  const take = (files: FileList | undefined, side: Side | null): void => {
    if (files !== undefined && files.length > 0) {
      actions.openFiles([...files], side);
    }
  };
  const drop = (event: DragEvent): void => {
    show(null);
    if (event.defaultPrevented) {
      return;
    }
    event.preventDefault();
    const folder = folderAmong(event.dataTransfer?.items);
    if (folder !== null) {
      actions.dispatch({ kind: 'error', sentence: `${folder} ${SENTENCES.folder}` });
      return;
    }
    take(event.dataTransfer?.files, sideAt(event.clientX, event.clientY));
  };
  const paste = (event: ClipboardEvent): void => {
    take(event.clipboardData?.files, null);
  };
  window.addEventListener('dragover', over);
  window.addEventListener('dragleave', leave);
  window.addEventListener('drop', drop);
  window.addEventListener('paste', paste);
  return () => {
    window.removeEventListener('dragover', over);
    window.removeEventListener('dragleave', leave);
    window.removeEventListener('drop', drop);
    window.removeEventListener('paste', paste);
  };
}

/** The veil over the views that says where dragged files will go. */
export function DropVeil({ actions }: { readonly actions: Actions }): VNode | null {
  const [over, setOver] = useState<Over>(null);
  useEffect(() => listen(actions, setOver), [actions]);
  if (over === null) {
    return null;
  }
  return (
    <div class="drop-veil">
      {(['Source', 'Target'] as const).map((name, side) => (
        <div key={name} class={over.side === side ? 'half over' : 'half'}>
          {name}
          <span class="small">a mesh, both, or landmarks too</span>
        </div>
      ))}
    </div>
  );
}
