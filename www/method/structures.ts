/** The discrete conformal structures with which a flow can be computed. */
import type { Scheme } from '../report.ts';

/** The name of a structure, and a sentence about it. */
export interface Structure {
  readonly name: string;
  readonly about: string;
}

/** All structures, the one of the texture first. */
export const STRUCTURES: Readonly<Record<Scheme, Structure>> = {
  inversive: {
    name: 'Inversive distance',
    about: 'Circles that do not meet grow and shrink; edges are flipped so that no triangle degenerates. This flow makes the texture.',
  },
  'vertex-scaling': {
    name: 'Vertex scaling',
    about: 'Edges grow by the factors of their two ends; they are flipped so that no triangle degenerates.',
  },
  'fixed-triangulation': {
    name: 'Inversive distance, no flips',
    about: 'The thesis’ flow, on the mesh’s own triangles: it stops where one of them loses its area.',
  },
  tangential: {
    name: 'Touching circles',
    about: 'Circles touch along every edge of the mesh. No triangle degenerates, but lengths begin as sums of radii, not as the mesh’s.',
  },
  thurston: {
    name: 'Overlapping circles',
    about: 'Thurston’s circles touch, or overlap by at most a right angle. No triangle degenerates; lengths are the mesh’s where such circles have them.',
  },
};
