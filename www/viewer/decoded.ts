/** Pictures of files as pixels. */

/** A picture's pixels: red, green, blue and opacity, row by row from the top. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly pixels: Uint8Array;
}

/** Pixels on the longer side: more is not seen at the views' size. */
const LARGEST = 2048;
/** So many pictures may be as large; of more each is smaller, so that all take no more memory. */
const LARGE_PICTURES = 4;

/** The pixels of a picture's file, one of so many, made smaller where there are many; `null` where it cannot be read. */
export async function decoded(file: Uint8Array<ArrayBuffer>, pictures = 1): Promise<Pixels | null> {
  try {
    const picture = await createImageBitmap(new Blob([file]));
    const largest = LARGEST / Math.sqrt(Math.max(1, pictures / LARGE_PICTURES));
    const scale = Math.min(1, largest / Math.max(picture.width, picture.height));
    const [width, height] = [Math.max(1, Math.round(scale * picture.width)), Math.max(1, Math.round(scale * picture.height))];
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context?.drawImage(picture, 0, 0, width, height);
    picture.close();
    const data = context?.getImageData(0, 0, width, height).data;
    return data === undefined ? null : { width, height, pixels: new Uint8Array(data.buffer) };
  } catch (thrown) {
    console.warn(thrown);
    return null;
  }
}
