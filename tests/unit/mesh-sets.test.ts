/** Which picture belongs to which mesh. */
import { beforeAll, describe, expect, test } from 'vitest';
import { gathered } from '../../www/mesh-sets.ts';
import { startPageModule } from './modules.ts';

beforeAll(() => {
  startPageModule();
});

function file(name: string, content = name): { readonly name: string; readonly bytes: Uint8Array } {
  return { name, bytes: new TextEncoder().encode(content) };
}

/** The names of the meshes with the names of their pictures, which are the pictures' contents. */
function sets(...files: readonly ReturnType<typeof file>[]): Record<string, string | null> {
  const entries = gathered(files).map(({ name, picture }) => [name, picture === undefined ? null : new TextDecoder().decode(picture)] as const);
  return Object.fromEntries(entries);
}

/** Bytes that begin like a PNG file. */
function png(name: string): { readonly name: string; readonly bytes: Uint8Array } {
  return { name, bytes: Uint8Array.from([0x89, ...new TextEncoder().encode(`PNG ${name}`)]) };
}

describe('a picture stays with its mesh', () => {
  test('by the mesh’s materials, of which each has its own', () => {
    const mesh = file('a/cat.obj', '# made by hand\r\nmtllib skins.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n');
    const materials = file('a/skins.mtl', 'newmtl eye\nmap_Kd C:\\x\\eye.png\nnewmtl coat\n  map_kd -o 1 1 1 textures/coat.png\r\n');
    const found = sets(mesh, materials, png('a/textures/coat.png'), png('a/eye.png'), png('a/cat.png'))['cat.obj'] ?? '';
    expect(found).toContain('PNG a/textures/coat.png');
    expect(found).toContain('PNG a/eye.png');
    expect(found).not.toContain('PNG a/cat.png');
    // Where the materials' pictures are missing, the picture with the mesh's name is taken.
    expect(sets(mesh, materials, file('cat.png'))).toEqual({ 'cat.obj': 'cat.png' });
    expect(sets(mesh, materials)['cat.obj']).toContain('textures/coat.png');
  });

  test('by its name', () => {
    expect(sets(file('cat.obj'), file('lion.ply'), file('lion.jpg'), file('cat.PNG'))).toEqual({
      'cat.obj': 'cat.PNG',
      'lion.ply': 'lion.jpg',
    });
  });

  test('where there is no other, and no other mesh', () => {
    expect(sets(file('cat.obj'), file('fur.webp'))).toEqual({ 'cat.obj': 'fur.webp' });
    expect(sets(file('cat.obj'), file('lion.obj'), file('fur.png'))).toEqual({ 'cat.obj': null, 'lion.obj': null });
    expect(sets(file('cat.obj'), file('fur.png'), file('skin.png'))).toEqual({ 'cat.obj': null });
    expect(sets(file('cat.stl'), file('cat.png'))).toEqual({ 'cat.stl': null });
  });
});
