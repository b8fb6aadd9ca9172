/** Where the box of a popover lies: beside its button, and inside the window. */

/** The direction in which a box opens from its button, and the edge of the button at which it begins. */
export type Place = 'down start' | 'down end' | 'up start' | 'up end';

interface Size {
  readonly width: number;
  readonly height: number;
}

interface Placement {
  readonly left: number;
  readonly top: number;
  readonly maxHeight: number;
}

/** The distance between a box and its button, in pixels. */
const GAP = 4;
/** The least distance between a box and the window's edges. */
const MARGIN = 8;

/**
 * The place of a box of this size, of which a part scrolls where the window is too low; it opens the other way where it fits only there, or
 * where neither way is enough and there is more room.
 */
export function placement(button: Pick<DOMRect, 'left' | 'right' | 'top' | 'bottom'>, box: Size, room: Size, place: Place): Placement {
  const above = button.top - GAP - MARGIN;
  const below = room.height - button.bottom - GAP - MARGIN;
  const [wanted, other] = place.startsWith('up') ? [above, below] : [below, above];
  const isTurned = box.height > wanted && other > wanted;
  const isUp = place.startsWith('up') !== isTurned;
  const maxHeight = Math.max(0, isUp ? above : below);
  const height = Math.min(box.height, maxHeight);
  const left = place.endsWith('start') ? button.left : button.right - box.width;
  return {
    left: Math.max(MARGIN, Math.min(left, room.width - MARGIN - box.width)),
    top: isUp ? button.top - GAP - height : button.bottom + GAP,
    maxHeight,
  };
}

/** Opens a box over the page and keeps it in its place until the returned function is called. */
export function keepInPlace(box: HTMLElement, button: HTMLElement, place: Place): () => void {
  // Over the page the box is not cut off at the edge of a view; a browser without such boxes shows it where it is.
  if ('showPopover' in box) {
    box.showPopover();
  }
  const put = (): void => {
    const size = { width: box.offsetWidth, height: box.scrollHeight + box.offsetHeight - box.clientHeight };
    const room = { width: window.innerWidth, height: window.innerHeight };
    const { left, top, maxHeight } = placement(button.getBoundingClientRect(), size, room, place);
    Object.assign(box.style, { left: `${left}px`, top: `${top}px`, maxHeight: `${maxHeight}px` });
  };
  put();
  const observer = new ResizeObserver(put);
  [box, ...box.children, button, document.documentElement].forEach((element) => {
    observer.observe(element);
  });
  window.addEventListener('resize', put);
  // The button may be in a part of the page that scrolls.
  document.addEventListener('scroll', put, true);
  return () => {
    observer.disconnect();
    window.removeEventListener('resize', put);
    document.removeEventListener('scroll', put, true);
  };
}
