/** A ball, and a rod with the same connectivity, whose triangles are all long. */

type Place = readonly [number, number, number];

/** The regular tetrahedron, each triangle split into 256 and projected to the unit sphere; its own vertices are the first. */
function ball(): { readonly places: readonly Place[]; readonly faces: readonly Place[] } {
  const unit = ([x, y, z]: Place): Place => {
    const length = Math.hypot(x, y, z);
    return [x / length, y / length, z / length];
  };
  const corners: Place[] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
  const places = corners.map(unit);
  let faces: Place[] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
  for (let round = 0; round < 4; round += 1) {
    const middles = new Map<string, number>();
    const middle = (a: number, b: number): number => {
      const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
      const known = middles.get(key);
      if (known !== undefined) {
        return known;
      }
      const [p, q] = [places[a] ?? [0, 0, 0], places[b] ?? [0, 0, 0]];
      places.push(unit([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
      middles.set(key, places.length - 1);
      return places.length - 1;
    };
    faces = faces.flatMap(([a, b, c]): Place[] => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  }
  return { places, faces };
}

/** The ball stretched along the first axis, as OBJ. */
export function rod(stretch: number): string {
  const { places, faces } = ball();
  const vertices = places.map(([x, y, z]) => `v ${stretch * x} ${y} ${z}`);
  return [...vertices, ...faces.map(([a, b, c]) => `f ${a + 1} ${b + 1} ${c + 1}`)].join('\n');
}

/** A landmark file that pairs the tetrahedron's corners on two such meshes. */
export const CORNERS = JSON.stringify({ pairs: [0, 1, 2, 3].map((v) => [v, v]) });
