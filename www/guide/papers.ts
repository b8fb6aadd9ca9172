/** The papers that the method stands on, in the order in which README.md names them. */

export interface Paper {
  readonly authors: string;
  readonly year: number;
  readonly title: string;
  readonly where: string;
  /** What the program takes from it. */
  readonly use: string;
}

export const PAPERS: readonly Paper[] = [
  { authors: 'Kraevoy & Sheffer', year: 2004, title: 'Cross-parameterization and compatible remeshing of 3D models', where: 'ACM Transactions on Graphics 23 (3)', use: 'corresponding paths' },
  { authors: 'Garland & Heckbert', year: 1997, title: 'Surface simplification using quadric error metrics', where: 'SIGGRAPH', use: 'coarse meshes' },
  { authors: 'Hoppe', year: 1996, title: 'Progressive meshes', where: 'SIGGRAPH', use: 'vertices that come back one by one' },
  { authors: 'Smith & Schaefer', year: 2015, title: 'Bijective parameterization with free boundaries', where: 'ACM Transactions on Graphics 34 (4)', use: 'the symmetric Dirichlet energy' },
  { authors: 'Shtengel, Poranne, Sorkine-Hornung, Kovalsky & Lipman', year: 2017, title: 'Geometric optimization via composite majorization', where: 'ACM Transactions on Graphics 36 (4)', use: 'Newton’s method' },
  { authors: 'Smith, de Goes & Kim', year: 2019, title: 'Analytic eigensystems for isotropic distortion energies', where: 'ACM Transactions on Graphics 38 (1)', use: 'the projected Hessian' },
  { authors: 'Chen & Medioni', year: 1991, title: 'Object modeling by registration of multiple range images', where: 'IEEE International Conference on Robotics and Automation', use: 'poses of one body' },
  { authors: 'Shewchuk', year: 1997, title: 'Adaptive precision floating-point arithmetic and fast robust geometric predicates', where: 'Discrete & Computational Geometry 18', use: 'the certificate' },
  { authors: 'Yang, Guo, Luo, Hu & Gu', year: 2009, title: 'Generalized discrete Ricci flow', where: 'Computer Graphics Forum 28 (7)', use: 'flat metrics' },
  { authors: 'Zhang, Guo, Zeng, Luo, Yau & Gu', year: 2014, title: 'The unified discrete surface Ricci flow', where: 'Graphical Models 76', use: 'flat metrics' },
  { authors: 'Bobenko & Lutz', year: 2023, title: 'Decorated discrete conformal maps and convex polyhedral cusps', where: 'arXiv', use: 'flips that keep the energy convex' },
  { authors: 'Gillespie, Springborn & Crane', year: 2021, title: 'Discrete conformal equivalence of polyhedral surfaces', where: 'ACM Transactions on Graphics 40 (4)', use: 'flips for vertex scaling' },
  { authors: 'Kyng & Sachdeva', year: 2016, title: 'Approximate Gaussian elimination for Laplacians', where: 'IEEE Symposium on Foundations of Computer Science', use: 'the preconditioner' },
  { authors: 'Gao, Kyng & Spielman', year: 2023, title: 'Robust and practical solution of Laplacian equations by approximate elimination', where: 'arXiv', use: 'the preconditioner' },
];
