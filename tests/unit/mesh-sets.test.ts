/** Which picture stays with which mesh. */
import { beforeAll, describe, expect, test } from 'vitest';
import { gathered } from '../../www/mesh-sets.ts';
import { startPageModule } from './modules.ts';

beforeAll(() => {
  startPageModule();
});

function file(name: string, content = name): { readonly name: string; readonly bytes: Uint8Array } {
  return { name, bytes: new TextEncoder().encode(content) };
}

/** The names of the meshes with their pictures', which are their contents. */
function sets(...files: readonly ReturnType<typeof file>[]): Record<string, string | null> {
  const entries = gathered(files).map(({ name, picture }) => [name, picture === undefined ? null : new TextDecoder().decode(picture)] as const);
  return Object.fromEntries(entries);
}

describe('a picture stays with its mesh', () => {
  test('by the mesh’s materials', () => {
    const mesh = file('a/cat.obj', '# made by hand\r\nmtllib skins.mtl\r\nv 0 0 0\r\n');
    const materials = file('a/skins.mtl', 'newmtl eye\nKd 1 0 0\nnewmtl coat\n  map_kd -o 1 1 1 textures/coat.png\r\n');
    expect(sets(mesh, materials, file('a/textures/coat.png'), file('a/cat.png'))).toEqual({ 'cat.obj': 'a/textures/coat.png' });
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
