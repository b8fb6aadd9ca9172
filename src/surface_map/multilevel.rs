//! Coarse first: the map of two coarse meshes, refined to the full meshes.
//!
//! The base domain is drawn on coarse levels of both meshes, where everything costs milliseconds. Their parametrisations are
//! relaxed, the points that the drawing added are taken out again, and the vertices of the full meshes come back level by
//! level, while the energy of the map itself is lowered on every level. So the full meshes start near the optimum, and are
//! never cut along the drawing.

use super::certificate::base_lines::mend_anchors;
use super::energy::map_energy::MapEnergy;
use super::energy::point_constraint::PointConstraint;
use super::error::MapError;
use super::overlay::location::{barycentric, locate};
use super::overlay::overlay;
use super::parametrisation::cone_surface::ConeSurface;
use super::parametrisation::embedding::{Embedding, Parametrised};
use super::parametrisation::initial::{self, InitialOptions};
use super::parametrisation::level::ParametrisedLevel;
use super::parametrisation::problem::FlatRelaxOptions;
use super::parametrisation::rest_triangle::RestTriangle;
use super::patch_fit::Skin;
use super::relaxation::dent_energy::DentEnergy;
use super::relaxation::dents::{self, DentOptions};
use super::relaxation::map_relaxation::{self, MapRelaxationOptions, Relaxed};
use super::relief::{self, ReliefOptions, Seen};
use crate::landmarks::Landmarks;
use crate::layout::{BaseLayout, PatchedMesh};
use crate::mesh::coarsening::{Level, coarsen_around};
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::Monitor;
use glam::DVec3;
use std::sync::Arc;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// How a map is solved from coarse to fine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultilevelOptions {
    /// Vertices of the coarse level.
    pub coarse_vertices: usize,
    /// Growth from level to level.
    pub growth: f64,
    /// The first parametrisation of a coarse level.
    pub initial: InitialOptions,
    /// The relaxation of each coarse side on its own.
    pub relax: FlatRelaxOptions,
    /// The relaxation of the map of the coarse level by which a layout is judged.
    pub judge: MapRelaxationOptions,
    /// So many of the best layouts are judged a second time.
    pub finalists: usize,
    /// Those whose mean log density is at most this many times the least one.
    pub close: f64,
    /// Maps whose mean log density is within this factor of the least one after the second judgement are judged again on
    /// finer levels.
    pub undecided: f64,
    /// Finer levels on which they are, at most.
    pub finer: usize,
    /// The relaxation for the second judgement.
    pub decide: MapRelaxationOptions,
    /// The relaxation of the map of the coarse level that was chosen.
    pub coarse: MapRelaxationOptions,
    /// A coarse map with a median distortion below this is between two poses of one body: it is relaxed by
    /// [`MapEnergy::POSES`] from then on.
    pub pose_median: f64,
    /// The relaxation of the map on every finer level.
    pub fine: MapRelaxationOptions,
    /// How the map between two poses follows the relief of the skin.
    pub relief: ReliefOptions,
    /// How the worst places of the full map are healed.
    pub dents: DentOptions,
}

impl Default for MultilevelOptions {
    fn default() -> Self {
        Self {
            coarse_vertices: 500,
            growth: 2.0,
            initial: InitialOptions::default(),
            relax: FlatRelaxOptions::default(),
            judge: MapRelaxationOptions {
                max_rounds: 1,
                energy: MapEnergy::JUDGE,
                ..MapRelaxationOptions::default()
            },
            finalists: 4,
            close: 1.3,
            undecided: 1.1,
            finer: 1,
            decide: MapRelaxationOptions {
                max_rounds: 5,
                energy: MapEnergy::JUDGE,
                ..MapRelaxationOptions::default()
            },
            // A round costs little here, and what is left undone shows on every finer level.
            coarse: MapRelaxationOptions {
                max_rounds: 60,
                relative_decrease: 2e-5,
                ..MapRelaxationOptions::default()
            },
            pose_median: 1.09,
            fine: MapRelaxationOptions {
                max_rounds: 10,
                relative_decrease: 3e-4,
                ..MapRelaxationOptions::default()
            },
            relief: ReliefOptions::default(),
            dents: DentOptions::default(),
        }
    }
}

/// One mesh with its coarse level.
pub struct Side<'a> {
    /// Area 1.
    full: &'a SurfaceMesh,
    landmarks: &'a TiSlice<VertexId, VertexId>,
    mesh: CollapsibleMesh,
    /// The coarse level.
    pub coarse: Level,
}

impl<'a> Side<'a> {
    /// Coarsens a mesh of area 1 to about `goal` vertices, the landmarks among them.
    pub fn new(full: &'a SurfaceMesh, landmarks: &'a TiSlice<VertexId, VertexId>, goal: usize) -> Self {
        let mut is_landmark = ti_vec![false; full.vertex_count()];
        landmarks.iter().for_each(|&v| is_landmark[v] = true);
        let mut mesh = CollapsibleMesh::new(full);
        coarsen_around(&mut mesh, full.positions(), goal, &is_landmark);
        let coarse = Level::of(&mesh, full.positions());
        Self { full, landmarks, mesh, coarse }
    }

    /// The coarse level's vertex of each landmark.
    fn coarse_landmarks(&self) -> Vec<VertexId> {
        self.coarse.numbers(self.landmarks).collect()
    }
}

/// The landmarks on both coarse levels.
pub fn coarse_landmarks(sides: &[Side<'_>; 2]) -> Landmarks {
    let [source, target] = [0, 1].map(|k| sides[k].coarse_landmarks());
    Landmarks { source, target }
}

/// Both coarse levels with their parametrisations.
#[derive(Clone)]
pub struct CoarseMap<'a> {
    /// The cone surface of its layout.
    pub surface: Arc<ConeSurface>,
    levels: [ParametrisedLevel<'a>; 2],
    /// Half the sum of the means over both coarse levels of the logarithm of the distortion density; 0 for an isometry.
    pub mean_log: f64,
    /// Half of both coarse levels is distorted by no more than this.
    pub median: f64,
    /// What is lowered on finer levels.
    energy: MapEnergy,
    /// By side the vertices of the full mesh that are drawn to places on the other side.
    pulls: [Vec<(VertexId, PointConstraint)>; 2],
    full: [&'a SurfaceMesh; 2],
    /// By side the full mesh's vertex of each landmark.
    landmarks: [&'a TiSlice<VertexId, VertexId>; 2],
}

/// A map of two coarse levels, from a layout drawn on them, relaxed as far as a judgement needs.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::LayoutPoints`]: another layout or a finer level may help.
pub fn solve_coarse<'a>(
    sides: &'a [Side<'a>; 2],
    layout: &BaseLayout,
    (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
) -> Result<CoarseMap<'a>, MapError> {
    let surface = Arc::new(ConeSurface::of_layout(layout)?);
    let mut level = |side: &'a Side<'a>, patched: &PatchedMesh| {
        let (start, _) = initial::embed(patched, &surface, &options.initial, monitor)?;
        let (relaxed, _) = initial::relax(patched.parametrised(&start), &surface, &options.relax, monitor)?;
        without_layout_points(side, patched, (&surface, &relaxed), (options, monitor))
    };
    let levels = [level(&sides[0], &layout.source)?, level(&sides[1], &layout.target)?];
    let mut map = CoarseMap {
        surface,
        levels,
        mean_log: f64::INFINITY,
        median: f64::INFINITY,
        energy: options.fine.energy,
        pulls: Default::default(),
        full: [sides[0].full, sides[1].full],
        landmarks: [sides[0].landmarks, sides[1].landmarks],
    };
    map.relax((&options.judge, monitor))?;
    Ok(map)
}

impl CoarseMap<'_> {
    /// Relaxes the coarse map that was chosen, and finds out whether it is between two poses of one body.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    pub fn finish(
        &mut self,
        (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
    ) -> Result<(), MapError> {
        self.relax((&options.coarse, &mut *monitor))?;
        if self.median < options.pose_median {
            self.energy = MapEnergy::POSES;
            self.relax((&MapRelaxationOptions { energy: self.energy, ..options.coarse }, monitor))?;
        }
        Ok(())
    }

    /// The present levels with the images of the source level's vertices; `None` where a vertex is not found on the target.
    pub fn images(&self) -> Option<LevelImages> {
        let present = self.present();
        let [source, target] = [0, 1].map(|k| present[k].parametrised());
        let locations = locate(source, target, &self.surface).ok()?;
        let target_from_source =
            locations.by_vertex.iter().map(|at| barycentric(source, target, at)).collect();
        Some(LevelImages { levels: present.map(|p| p.level), target_from_source })
    }

    fn present(&self) -> [Present; 2] {
        [0, 1].map(|k| {
            let (level, mut embedding) = self.levels[k].snapshot();
            let landmarks: TiVec<VertexId, VertexId> = level.numbers(self.landmarks[k]).collect();
            mend_anchors(&mut embedding, (&level.mesh, &landmarks), &self.surface);
            Present { level, landmarks, embedding }
        })
    }

    /// Lowers the energy of the map of the coarse levels and measures it.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    pub fn relax(
        &mut self,
        (options, monitor): (&MapRelaxationOptions, &mut dyn Monitor),
    ) -> Result<(), MapError> {
        let measure = |relaxed: &Relaxed<'_>| (relaxed.mean_log(), relaxed.median());
        (self.mean_log, self.median) = self.lower((options, monitor), measure)?;
        Ok(())
    }

    /// Between two poses, on levels of the right size, draws vertices to where the relief of the skin says that they belong.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn follow_relief(
        &mut self,
        (options, fine, monitor): (&ReliefOptions, &MapRelaxationOptions, &mut dyn Monitor),
    ) -> Result<(), MapError> {
        let [least, most] = options.vertices;
        let fits = |level: &ParametrisedLevel<'_>| (least..=most).contains(&level.mesh().live_vertices());
        if self.energy != MapEnergy::POSES || !self.levels.iter().all(fits) {
            return Ok(());
        }
        let skins = [0, 1].map(|k| Skin::new(self.full[k]));
        let skins = [&skins[0], &skins[1]];
        for _ in 0..options.rounds {
            if monitor.wants_result() {
                break;
            }
            self.look(|k, seen, pulls| {
                let found = relief::pulls([skins[k], skins[1 - k]], seen, options);
                *pulls = found.into_iter().map(|(v, pull)| (seen.vertices[v], pull)).collect();
            });
            self.lower((&MapRelaxationOptions { max_rounds: 4, ..*fine }, &mut *monitor), |_| ())?;
        }
        // Finer levels hold what has settled: a pull of one of their small triangles would dent the map.
        self.look(|_, seen, pulls| {
            for (v, pull) in pulls {
                if let Ok(v) = seen.vertices.binary_search(v) {
                    pull.place = seen.images[v];
                }
            }
        });
        Ok(())
    }

    /// Brings vertices back on both sides, as many times more as a level has; `false` where none is missing.
    fn grow(&mut self, (options, monitor): (&MultilevelOptions, &mut dyn Monitor)) -> Result<bool, MapError> {
        let mut grown = false;
        for level in &mut self.levels {
            let (live, full) = (level.mesh().live_vertices(), level.full_vertices());
            let next = (live as f64 * options.growth) as usize;
            // No level that is only a little coarser than the full mesh.
            let goal = if 2 * next > full { full } else { next };
            grown |= goal > live;
            let quiet = InitialOptions { growth: f64::INFINITY, ..options.initial };
            initial::refine(level, goal, &quiet, monitor)?;
        }
        Ok(grown)
    }

    /// Goes to the next finer level and judges the map there; `false` where there is none.
    ///
    /// # Errors
    /// [`MapError::NoStart`], [`MapError::Cancelled`].
    pub fn judge_finer(
        &mut self,
        (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
    ) -> Result<bool, MapError> {
        let grown = self.grow((options, &mut *monitor))?;
        if grown {
            self.relax((&options.decide, monitor))?;
        }
        Ok(grown)
    }

    /// Heals the worst places of the present levels.
    fn heal(&mut self, options: &DentOptions) {
        let present = self.present();
        let [source, target] = [0, 1].map(|k| present[k].parametrised());
        let Ok(locations) = locate(source, target, &self.surface) else { return };
        let Ok(overlay) = overlay(source, target, &locations) else { return };
        let brink = if self.energy == MapEnergy::POSES { options.pose_brink } else { options.brink };
        let energy = DentEnergy { energy: self.energy, brink };
        let healed = dents::heal([source, target], (&overlay, &self.surface), (options, energy));
        for (k, embedding) in healed.iter().flatten().enumerate() {
            self.levels[k].adopt(&present[k].level, embedding);
        }
    }

    /// Shows each side's level with its images, and its pulls.
    fn look(&mut self, mut show: impl FnMut(usize, &Seen<'_>, &mut Vec<(VertexId, PointConstraint)>)) {
        let present = self.present();
        for k in 0..2 {
            let [from, onto] = [k, 1 - k].map(|k| present[k].parametrised());
            let [level, other] = [k, 1 - k].map(|k| &present[k].level);
            let Ok(locations) = locate(from, onto, &self.surface) else { continue };
            let points = locations.by_vertex.iter().map(|at| barycentric(from, onto, at));
            let seen = Seen::new((&level.mesh, &level.vertices), (&other.mesh, &other.vertices), points);
            show(k, &seen, &mut self.pulls[k]);
        }
    }

    /// Lowers the energy of the map of the present levels; answers with what `look` sees in it.
    fn lower<T>(
        &mut self,
        (options, monitor): (&MapRelaxationOptions, &mut dyn Monitor),
        look: impl FnOnce(&Relaxed<'_>) -> T,
    ) -> Result<T, MapError> {
        let present = self.present();
        let parametrised = [0, 1].map(|k| present[k].parametrised());
        let pulls = [0, 1].map(|k| on_level(&self.pulls[k], &present[k].level));
        let pulls = [&pulls[0][..], &pulls[1][..]];
        let relaxed =
            map_relaxation::relax_constrained(parametrised, (&self.surface, pulls), options, monitor)?;
        let seen = look(&relaxed);
        let embeddings = relaxed.into_embeddings();
        for k in 0..2 {
            self.levels[k].adopt(&present[k].level, &embeddings[k]);
        }
        Ok(seen)
    }
}

/// The pulls of those vertices that are in a level, by its numbers.
fn on_level(pulls: &[(VertexId, PointConstraint)], level: &Level) -> Vec<(VertexId, PointConstraint)> {
    let number =
        |(v, pull): &(VertexId, PointConstraint)| Some((level.vertices.binary_search(v).ok()?, *pull));
    pulls.iter().filter_map(number).collect()
}

/// The level of one side that is present.
struct Present {
    level: Level,
    landmarks: TiVec<VertexId, VertexId>,
    embedding: Embedding,
}

impl Present {
    fn parametrised(&self) -> Parametrised<'_> {
        Parametrised {
            mesh: &self.level.mesh,
            landmark_vertices: &self.landmarks,
            embedding: &self.embedding,
        }
    }
}

/// The map of two levels, read off at the source level's vertices.
pub struct LevelImages {
    /// Source and target level.
    pub levels: [Level; 2],
    /// The point of the target level that belongs to each vertex of the source level.
    pub target_from_source: TiVec<VertexId, SurfacePoint>,
}

/// Brings all vertices back, relaxing level by level.
///
/// # Errors
/// [`MapError::NoStart`].
pub fn solve_fine(
    mut map: CoarseMap<'_>,
    (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
) -> Result<[Embedding; 2], MapError> {
    while map.grow((options, &mut *monitor))? {
        let fine = MapRelaxationOptions { energy: map.energy, ..options.fine };
        // The finest level has room for what pulls have dented, and hardly moves otherwise.
        let is_finest = map.levels.iter().all(ParametrisedLevel::is_full);
        if is_finest {
            map.pulls = Default::default();
        }
        map.lower((&fine, &mut *monitor), |_| ())?;
        map.follow_relief((&options.relief, &fine, &mut *monitor))?;
        if is_finest && map.pulls.iter().any(|pulls| !pulls.is_empty()) {
            map.pulls = Default::default();
            map.lower((&fine, &mut *monitor), |_| ())?;
        }
    }
    map.heal(&options.dents);
    Ok(map.levels.map(|level| level.snapshot().1))
}

/// A vertex of a patched mesh that the layout added: on an edge of the mesh before, or inside a face.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Added {
    OnEdge([VertexId; 2]),
    Inside,
}

/// The coarse level's own parametrisation: the points that the layout added are taken out.
fn without_layout_points<'a>(
    side: &'a Side<'a>,
    patched: &PatchedMesh,
    (surface, embedding): (&Arc<ConeSurface>, &Embedding),
    (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
) -> Result<ParametrisedLevel<'a>, MapError> {
    let coarse = &side.coarse.mesh;
    let first = coarse.vertex_count();
    let added: Vec<Added> =
        (first..patched.mesh.vertex_count()).map(|v| origin(patched, coarse, v.into())).collect();
    let mut refined = ParametrisedLevel::on_level(
        (CollapsibleMesh::new(&patched.mesh), patched.mesh.positions()),
        &patched.landmark_vertices,
        surface.clone(),
        (embedding, |h| h),
    );
    let mut left: Vec<VertexId> = (first..patched.mesh.vertex_count()).map(VertexId::from).collect();
    let kind = |v: VertexId| added.get(v.index().wrapping_sub(first)).copied();
    take_out(&mut refined, &mut left, kind);
    for pull in [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3] {
        if left.is_empty() {
            break;
        }
        let rest = pulled_together(&refined, patched.mesh.positions(), (&left, pull), kind);
        refined.relax_to(&rest, &options.relax, monitor)?;
        take_out(&mut refined, &mut left, kind);
    }
    if !left.is_empty() {
        let near = nearest_landmarks(patched, &left);
        return Err(MapError::LayoutPoints { left: left.len(), near });
    }
    let (level, embedding) = refined.snapshot();
    let same = |h: HalfedgeId| {
        let (tail, head) = (level.mesh.tail(h), level.mesh.head(h));
        let own = coarse.halfedge_between(tail, head).unwrap_or(h);
        HalfedgeId::of(side.coarse.faces[own.face()], own.corner())
    };
    Ok(ParametrisedLevel::on_level(
        (side.mesh.clone(), side.full.positions()),
        side.landmarks,
        surface.clone(),
        (&embedding, same),
    ))
}

/// The landmarks nearest in space to some vertices, each once.
fn nearest_landmarks(patched: &PatchedMesh, vertices: &[VertexId]) -> Vec<usize> {
    let place = |v: VertexId| patched.mesh.positions()[v];
    let nearest = |&v: &VertexId| {
        let distance = |l: &VertexId| place(*l).distance_squared(place(v));
        let landmarks = patched.landmark_vertices.iter().enumerate();
        landmarks.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map(|(landmark, _)| landmark)
    };
    let mut near: Vec<usize> = vertices.iter().filter_map(nearest).collect();
    near.sort_unstable();
    near.dedup();
    near
}

fn origin(patched: &PatchedMesh, coarse: &SurfaceMesh, v: VertexId) -> Added {
    let at = patched.vertex_origin[v];
    let corners = coarse.triangles()[at.face];
    match (0..3).find(|&k| at.barycentric[k] < 1e-12) {
        Some(k) => {
            let [a, b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
            Added::OnEdge([a.min(b), a.max(b)])
        }
        None => Added::Inside,
    }
}

/// Whether an added point may go into a neighbour: along its edge, or anywhere from inside a face.
fn is_along(v: VertexId, w: VertexId, added: impl Fn(VertexId) -> Option<Added>) -> bool {
    match added(v) {
        Some(Added::OnEdge(ends)) => ends.contains(&w) || added(w) == Some(Added::OnEdge(ends)),
        _ => true,
    }
}

/// Rest shapes in which each point that is left lies near a neighbour on its edge, at `pull` of the distance. The triangles
/// beside count as much as others, so that they really draw the two together.
fn pulled_together(
    level: &ParametrisedLevel<'_>,
    positions: &TiSlice<VertexId, DVec3>,
    (left, pull): (&[VertexId], f64),
    added: impl Fn(VertexId) -> Option<Added>,
) -> Vec<RestTriangle> {
    let mesh = level.mesh();
    let mut rest: TiVec<VertexId, DVec3> = positions.to_owned();
    let mut is_left = ti_vec![false; positions.len()];
    for &v in left {
        is_left[v] = true;
        let length = |h: &HalfedgeId| positions[v].distance(positions[mesh.head(*h)]);
        let ways = mesh.star(v).filter(|&h| is_along(v, mesh.head(h), &added));
        let way = ways.min_by(|a, b| {
            let own = |h: &HalfedgeId| added(mesh.head(*h)).is_some();
            own(a).cmp(&own(b)).then(length(a).total_cmp(&length(b)))
        });
        if let Some(h) = way {
            let end = positions[mesh.head(h)];
            rest[v] = end + (positions[v] - end) * pull;
        }
    }
    let mean = 1.0 / mesh.faces().count() as f64;
    let triangle = |f| {
        let corners = mesh.corners(f);
        let triangle = RestTriangle::of(corners.map(|v| rest[v]));
        if corners.iter().any(|&v| is_left[v]) {
            RestTriangle { weight: triangle.weight.max(mean), ..triangle }
        } else {
            triangle
        }
    };
    mesh.faces().map(triangle).collect()
}

/// Takes out what can be taken out: a point on an edge along its edge, a point inside a face into any neighbour.
fn take_out(
    level: &mut ParametrisedLevel<'_>,
    left: &mut Vec<VertexId>,
    added: impl Fn(VertexId) -> Option<Added>,
) {
    let mut before = usize::MAX;
    while left.len() < before {
        before = left.len();
        left.retain(|&v| {
            let along = |w: VertexId| is_along(v, w, &added);
            let ways: Vec<HalfedgeId> =
                level.mesh().star(v).filter(|&h| along(level.mesh().head(h))).collect();
            !ways.into_iter().any(|h| level.mesh().link_condition(h) && level.remove(h))
        });
    }
}
