//! One map of a survey, and its figures.

use crate::arguments::Arguments;
use crate::common;
use conemap::demo;
use conemap::landmarks::{Landmarks, PlacedLandmarks};
use conemap::mesh::insertion::insert;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use conemap::pipeline::{CapFaces, GroundTruth, MapInput, MapResult, PipelineOptions, findings, run};
use cpu_time::ThreadTime;
use glam::DVec3;
use std::time::Instant;

/// Two meshes with corresponding points.
pub struct Case {
    pub name: String,
    pub variant: String,
    pub meshes: [SurfaceMesh; 2],
    /// The landmarks on the source and on the target, in the order of the pairs.
    pub points: [Vec<SurfacePoint>; 2],
    /// The true image of each vertex of the source in space, not a number for a vertex whose image is not known; `None` where none is.
    pub truth: Option<Vec<DVec3>>,
}

/// The figures of a map.
#[derive(Clone, Debug, Default)]
pub struct Reached {
    pub certified: bool,
    pub energy: f64,
    pub mean: f64,
    pub mean_log: f64,
    pub p95: f64,
    pub max: f64,
    /// The share of the area with a density above 20, of the source or of the target, whichever is larger.
    pub dented: f64,
    /// Mean, median and 95 % quantile of the distance to the true images, in units of the root of the target's area.
    pub truth: Option<[f64; 3]>,
    /// The number of points that the program added as cones of its own.
    pub own: usize,
    /// The number of layouts that were judged by their coarse maps.
    pub judged: usize,
    /// The mean log density of the chosen coarse map and that of the next best class.
    pub coarse: [f64; 2],
}

/// A line of a table.
pub struct Outcome {
    pub name: String,
    pub variant: String,
    pub reached: Result<Reached, String>,
    /// Seconds of processor time of the thread that made the map.
    pub seconds: f64,
}

/// A monitor that cancels a run after so many seconds of processor time.
pub struct Limit {
    begun: ThreadTime,
    seconds: f64,
}

impl Limit {
    /// Starts the clock.
    pub fn new(seconds: f64) -> Self {
        Self { begun: ThreadTime::now(), seconds }
    }
}

impl Monitor for Limit {
    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        if self.begun.elapsed().as_secs_f64() > self.seconds { Err(Cancelled) } else { Ok(()) }
    }
}

impl Case {
    /// A demo with its landmarks.
    ///
    /// # Panics
    /// Panics where there is no demo of this name.
    pub fn of_demo(id: &str) -> Self {
        let demo = demo::build(id).expect("a demo of the list");
        let meshes = [demo.source, demo.target];
        let points = [0, 1].map(|side| {
            let at = |pair: &[u32; 2]| SurfacePoint::at_vertex(&meshes[side], VertexId(pair[side]));
            demo.landmarks.iter().map(at).collect()
        });
        Self { name: id.to_owned(), variant: String::new(), meshes, points, truth: demo.truth }
    }

    /// A pair of the data folder as it is, its landmarks thinned where that is asked for.
    pub fn of_pair(arguments: &Arguments, name: &str) -> Self {
        let pair = common::read_pair(&arguments.data, name);
        let mut vertices = common::vertex_pairs(&pair.file);
        if arguments.landmarks > 0 {
            vertices = thinned(&pair.source, &vertices, arguments.landmarks);
        }
        let same = pair.file.ground_truth.is_some();
        let [source, target] = if same && arguments.vertices > 0 {
            let held: Vec<VertexId> = vertices.iter().map(|ends| VertexId(ends[0])).collect();
            let (meshes, held) = common::coarsened([&pair.source, &pair.target], &held, arguments.vertices);
            vertices = held.iter().map(|v| [v.0; 2]).collect();
            meshes
        } else {
            [pair.source, pair.target]
        };
        let points = [&source, &target].map(|mesh| (mesh, Vec::new()));
        let mut points: [(&SurfaceMesh, Vec<SurfacePoint>); 2] = points;
        for (k, (mesh, points)) in points.iter_mut().enumerate() {
            points.extend(vertices.iter().map(|ends| SurfacePoint::at_vertex(mesh, ends[k].into_vertex())));
        }
        let points = points.map(|(_, points)| points);
        let truth = same.then(|| target.positions().iter().copied().collect());
        Self { name: name.to_owned(), variant: String::new(), meshes: [source, target], points, truth }
    }

    /// Makes the map and measures it.
    pub fn map(&self, arguments: &Arguments) -> Outcome {
        let begun = ThreadTime::now();
        let reached = self.reached(arguments);
        let seconds = begun.elapsed().as_secs_f64();
        Outcome { name: self.name.clone(), variant: self.variant.clone(), reached, seconds }
    }

    /// Compares the landmark pairs and makes the map, as a job does after its files are read.
    pub fn run(&self, options: &PipelineOptions, monitor: &mut dyn Monitor) -> Result<(), String> {
        monitor.enter(Stage::Landmarks);
        let placed = self.placed()?;
        let input = Self::input(&placed);
        findings(input, &[], monitor).map_err(|e| e.to_string())?;
        run(input, options, monitor).map_err(|e| e.to_string())?;
        Ok(())
    }

    /// Both meshes with the points as vertices.
    pub fn placed(&self) -> Result<PlacedLandmarks, String> {
        let side = |k: usize| insert(&self.meshes[k], &self.points[k]).map_err(|e| e.to_string());
        let (source, target) = (side(0)?, side(1)?);
        let landmarks =
            Landmarks { source: source.vertices.clone().into(), target: target.vertices.clone().into() };
        Ok(PlacedLandmarks { source, target, landmarks })
    }

    /// The pipeline's input: both meshes with their landmarks, without caps or a known truth.
    pub fn input(placed: &PlacedLandmarks) -> MapInput<'_> {
        let PlacedLandmarks { source, target, landmarks } = placed;
        let ground_truth = GroundTruth::Unknown;
        MapInput {
            source: &source.mesh,
            target: &target.mesh,
            landmarks,
            ground_truth,
            caps: CapFaces::default(),
        }
    }

    fn reached(&self, arguments: &Arguments) -> Result<Reached, String> {
        let placed = self.placed()?;
        let input = Self::input(&placed);
        let mut limit = Limit::new(arguments.time_limit);
        let result = run(input, &arguments.options, &mut limit).map_err(|e| e.to_string())?;
        Ok(self.measured(&result, &placed))
    }

    fn measured(&self, result: &MapResult, placed: &PlacedLandmarks) -> Reached {
        let report = &result.report;
        let truth = self.truth.as_ref().map(|truth| {
            let target = &placed.target.mesh;
            let scale = 1.0 / target.area().sqrt();
            let distance = |(v, place): (usize, &DVec3)| {
                let image = result.target_from_source[conemap::mesh::VertexId::from(v)]
                    .expect("the relaxed map has all images");
                image.position(target).distance(*place) * scale
            };
            let known = truth.iter().enumerate().filter(|(_, place)| place.is_finite());
            mean_and_quantiles(known.map(distance).collect())
        });
        Reached {
            certified: report.certificate.as_ref().is_some_and(|c| c.bijective),
            energy: report.distortion.energy,
            mean: report.distortion.mean,
            mean_log: report.distortion.mean_log,
            p95: report.distortion.p95,
            max: report.distortion.max,
            dented: report.distortion.dented,
            truth,
            own: report.own_landmarks,
            judged: report.layout.as_ref().map_or(0, |layout| layout.judged),
            coarse: report.layout.as_ref().map_or([f64::NAN; 2], |layout| {
                [layout.mean_log, layout.runner_up].map(|value| value.unwrap_or(f64::NAN))
            }),
        }
    }
}

/// Keeps `count` of the pairs: first the one whose source point is farthest from the mean of all, then again and again the one that is
/// farthest in space from those kept.
pub fn thinned(source: &SurfaceMesh, all: &[[u32; 2]], count: usize) -> Vec<[u32; 2]> {
    let place = |pair: &[u32; 2]| source.positions()[pair[0].into_vertex()];
    let mean = all.iter().map(place).sum::<DVec3>() / all.len() as f64;
    let mut nearest: Vec<f64> = all.iter().map(|pair| place(pair).distance(mean)).collect();
    let mut chosen: Vec<[u32; 2]> = Vec::new();
    while chosen.len() < count.min(all.len()) {
        let far = (0..all.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).expect("pairs");
        if chosen.is_empty() {
            nearest.fill(f64::INFINITY);
        }
        chosen.push(all[far]);
        let last = place(&all[far]);
        nearest.iter_mut().zip(all).for_each(|(d, pair)| *d = d.min(place(pair).distance(last)));
    }
    chosen
}

/// Turns vertex numbers of landmark files into ids.
trait IntoVertex {
    fn into_vertex(self) -> conemap::mesh::VertexId;
}

impl IntoVertex for u32 {
    fn into_vertex(self) -> conemap::mesh::VertexId {
        conemap::mesh::VertexId(self)
    }
}

/// Makes a case (reads or changes its meshes) when the case's turn has come.
pub type Make<'a> = Box<dyn FnOnce() -> Case + Send + 'a>;

/// Maps all cases, as many at once as there are threads; prints each line as soon as it is known and returns the outcomes in the order of the
/// cases.
pub fn map_all(cases: Vec<Make<'_>>, arguments: &Arguments) -> Vec<Outcome> {
    let queue =
        std::sync::Mutex::new(cases.into_iter().enumerate().collect::<std::collections::VecDeque<_>>());
    let outcomes = std::sync::Mutex::new(Vec::new());
    let begun = Instant::now();
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some((number, make)) = next else { break };
                    let outcome = make().map(arguments);
                    println!("{}", crate::table::line(&outcome));
                    outcomes.lock().expect("a list").push((number, outcome));
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().expect("a list");
    outcomes.sort_by_key(|(number, _)| *number);
    println!("{:.0} s of wall time", begun.elapsed().as_secs_f64());
    outcomes.into_iter().map(|(_, outcome)| outcome).collect()
}

/// The mean, the median and the 95 % quantile of some numbers.
pub fn mean_and_quantiles(mut all: Vec<f64>) -> [f64; 3] {
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all[(share * (all.len() - 1) as f64) as usize];
    [all.iter().sum::<f64>() / all.len() as f64, at(0.5), at(0.95)]
}
