/** A mesh in two files. */

/** A tetrahedron as glTF whose buffer is in a second file; `uri` is the name of that file in the text. */
export function tetrahedron(uri: string): { readonly gltf: string; readonly bin: Uint8Array<ArrayBuffer> } {
  const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
  const bin = new Uint8Array([...new Uint8Array(new Float32Array(corners).buffer), ...faces]);
  const gltf = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5121, count: 12, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 12 },
    ],
    buffers: [{ byteLength: 60, uri }],
  };
  return { gltf: JSON.stringify(gltf), bin };
}
