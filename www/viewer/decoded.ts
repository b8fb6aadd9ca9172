/** Decodes the pictures of files into pixels. */

/** A picture's pixels: red, green, blue and opacity, row by row from the top. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly pixels: Uint8Array;
}

/** The most pixels on the longer side; more cannot be seen at the views' size. */
const LARGEST = 2048;
/** The number of pictures that may have this size. Where there are more, each is smaller, so that all together take no more memory. */
const LARGE_PICTURES = 4;

/** The pixels of a picture's file, made smaller where a mesh has many of them (`pictures`); `null` where it cannot be read. */
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
