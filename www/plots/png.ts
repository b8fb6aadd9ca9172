/** Converts an SVG into a PNG. */

/** A PNG of an SVG, larger than the drawing by the factor `times`; `null` where the browser makes none. */
export async function pngOf(svg: string, size: { readonly width: number; readonly height: number }, times: number): Promise<Blob | null> {
  const url = URL.createObjectURL(new Blob([svg], { type: 'image/svg+xml' }));
  try {
    const image = new Image(size.width * times, size.height * times);
    image.src = url;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = size.width * times;
    canvas.height = size.height * times;
    canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve) => {
      canvas.toBlob(resolve, 'image/png');
    });
  } finally {
    URL.revokeObjectURL(url);
  }
}
