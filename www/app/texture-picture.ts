/** Lays a picture of the user's on the flat metric. */
import type { Store } from '../store/store.ts';
import { decoded } from '../viewer/decoded.ts';

/** Bytes of a picture's file; no camera makes larger ones. */
const LARGEST = 64 * 2 ** 20;

/** How many were asked for: a slow one does not take the place of one that was chosen after it. */
let asked = 0;

/** Reads a picture and shows it; what cannot be read is told, and the last picture stays. */
export async function openTexturePicture(store: Store, file: File): Promise<void> {
  const number = ++asked;
  const tell = (sentence: string): void => {
    store.dispatch({ kind: 'error', sentence });
  };
  if (file.size > LARGEST) {
    tell(`${file.name} has ${Math.ceil(file.size / 2 ** 20)} MiB; a picture may have 64. Make it smaller.`);
    return;
  }
  const picture = await file.arrayBuffer().then(
    (bytes) => decoded(new Uint8Array(bytes)),
    () => null,
  );
  if (number !== asked) {
    return;
  }
  if (picture === null) {
    tell(`${file.name} is no picture that this browser can read: choose a PNG, JPEG or WebP file.`);
    return;
  }
  store.dispatch({ kind: 'texture-picture', picture: { name: file.name, ...picture } });
}
