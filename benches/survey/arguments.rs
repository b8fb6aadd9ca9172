//! The command line of a survey.

use crate::common;
use conemap::demo;
use conemap::pipeline::PipelineOptions;
use std::path::PathBuf;

/// The arguments of the command line.
#[derive(Clone)]
pub struct Arguments {
    /// The table's name.
    pub table: String,
    /// The data folder, which has the meshes and the pair files.
    pub data: PathBuf,
    /// The pairs to map, by their names or the beginnings of their names; empty for all pairs.
    pub pairs: Vec<String>,
    /// The variants to map, by their names; empty for all variants.
    pub variants: Vec<String>,
    /// The number of repetitions of a random variant, each with a seed of its own.
    pub seeds: u64,
    /// The first seed.
    pub seed: u64,
    /// Minutes of wall time after which a table without an end of its own (`torture`) stops.
    pub minutes: f64,
    /// The number of threads; each makes one map at a time.
    pub jobs: usize,
    /// Seconds of processor time after which a map is given up.
    pub time_limit: f64,
    /// The number of landmarks that are kept of each pair, chosen by farthest points; 0 keeps all.
    pub landmarks: usize,
    /// The number of vertices to which both meshes of a pair with a known truth are coarsened, with the same connectivity; 0 leaves them
    /// as they are.
    pub vertices: usize,
    /// Numbers of vertices of the coarse levels on which the table `classes` searches.
    pub levels: Vec<usize>,
    /// How much a table does beyond the usual. In `classes`: the number of twists made one after the other (1 or 2). In `orders`, `match`
    /// and the tables that measure silences 2 prints more lines: all layouts that were judged, all candidates, the calls after a long
    /// silence.
    pub depth: usize,
    /// The pipeline's options: the defaults, changed by what the command line says.
    pub options: PipelineOptions,
}

impl Arguments {
    /// Reads the arguments of this process. `--bench`, which cargo adds, is ignored.
    pub fn read() -> Self {
        let mut given = std::env::args().skip(1).filter(|argument| argument != "--bench");
        let mut arguments = Self {
            table: given.next().unwrap_or_default(),
            data: common::data_path(),
            pairs: Vec::new(),
            variants: Vec::new(),
            seeds: 1,
            seed: 1,
            minutes: 10.0,
            jobs: std::thread::available_parallelism().map_or(1, usize::from),
            time_limit: 150.0,
            landmarks: 0,
            vertices: 0,
            levels: vec![600, 1000],
            depth: 1,
            options: PipelineOptions::default(),
        };
        while let Some(option) = given.next() {
            let value = given.next().unwrap_or_else(|| panic!("{option} needs a value"));
            let number = || value.parse::<f64>().unwrap_or_else(|_| panic!("{option} {value}: not a number"));
            match option.as_str() {
                "--data" => arguments.data = value.into(),
                "--pairs" => arguments.pairs = value.split(',').map(str::to_owned).collect(),
                "--variants" => arguments.variants = value.split(',').map(str::to_owned).collect(),
                "--seeds" => arguments.seeds = number() as u64,
                "--seed" => arguments.seed = number() as u64,
                "--minutes" => arguments.minutes = number(),
                "--jobs" => arguments.jobs = number() as usize,
                "--time-limit" => arguments.time_limit = number(),
                "--landmarks" => arguments.landmarks = number() as usize,
                "--vertices" => arguments.vertices = number() as usize,
                "--levels" => {
                    arguments.levels = value.split(',').map(|n| n.parse().expect("a number")).collect()
                }
                "--depth" => arguments.depth = number() as usize,
                "--coarse" => arguments.options.multilevel.coarse_vertices = number() as usize,
                "--coarse-decrease" => arguments.options.multilevel.coarse.relative_decrease = number(),
                "--fine-decrease" => arguments.options.multilevel.fine.relative_decrease = number(),
                "--judge-rounds" => arguments.options.multilevel.judge.max_rounds = number() as usize,
                "--decide-rounds" => arguments.options.multilevel.decide.max_rounds = number() as usize,
                "--finalists" => arguments.options.multilevel.finalists = number() as usize,
                "--close" => arguments.options.multilevel.close = number(),
                "--coarse-barrier" => arguments.options.multilevel.coarse.barrier = number(),
                "--fine-barrier" => arguments.options.multilevel.fine.barrier = number(),
                "--coarse-rounds" => arguments.options.multilevel.coarse.max_rounds = number() as usize,
                "--fine-rounds" => arguments.options.multilevel.fine.max_rounds = number() as usize,
                "--patch-rounds" => arguments.options.multilevel.rigid_patches.rounds = number() as usize,
                "--patch-from" => {
                    arguments.options.multilevel.rigid_patches.least_vertices = number() as usize
                }
                "--patch-hold" => arguments.options.multilevel.rigid_patches.hold = number(),
                "--patch-noise" => arguments.options.multilevel.rigid_patches.fit.noise = number(),
                "--patch-spacing" => arguments.options.multilevel.rigid_patches.spacing = number(),
                "--own-rounds" => arguments.options.own_cones.rounds = number() as usize,
                "--own-patience" => arguments.options.own_cones.patience = number() as usize,
                "--own-gain" => arguments.options.own_cones.least_gain = number(),
                "--own-finer" => arguments.options.own_cones.finer_rounds = number() as usize,
                "--own-finer-vertices" => arguments.options.own_cones.finer_vertices = number() as usize,
                "--own-most" => arguments.options.own_cones.most_pose_landmarks = number() as usize,
                "--pose-mean-log" => arguments.options.multilevel.pose_mean_log = number(),
                "--own-twists" => arguments.options.own_cones.search.twists = number() as usize,
                "--own-candidates" => arguments.options.own_cones.search.candidates = number() as usize,
                "--twists" => arguments.options.search.twists = number() as usize,
                "--patience" => arguments.options.search.patience = number() as usize,
                "--candidates" => arguments.options.search.candidates = number() as usize,
                "--twist-ratio" => arguments.options.search.twist_ratio = number(),
                "--finer" => arguments.options.multilevel.finer = number() as usize,
                "--patch-knee" => arguments.options.multilevel.rigid_patches.knee = number(),
                "--patch-strength" => arguments.options.multilevel.rigid_patches.strength = number(),
                "--patch-radius" => arguments.options.multilevel.rigid_patches.radii[1] = number(),
                "--cap-weight" => arguments.options.multilevel.cap_weight = number(),
                "--toll" => arguments.options.multilevel.border_toll = number(),
                "--rim-draws" => arguments.options.multilevel.rim_draws.rounds = number() as usize,
                "--rim-strength" => arguments.options.multilevel.rim_draws.strength = number(),
                "--rim-vertices" => arguments.options.multilevel.rims.each = number() as usize,
                "--dent-sweeps" => arguments.options.multilevel.dents.sweeps = number() as usize,
                "--deep-sweeps" => arguments.options.multilevel.dents.deep_sweeps = number() as usize,
                "--dent-share" => arguments.options.multilevel.dents.share = number(),
                "--growth" => arguments.options.multilevel.growth = number(),
                "--own" => arguments.options.own_cones.count = number() as usize,
                _ => panic!("unknown option {option}"),
            }
        }
        arguments
    }

    /// The names of the demos that are asked for.
    pub fn demos(&self) -> Vec<&'static str> {
        let is_asked =
            |id: &str| self.pairs.is_empty() || self.pairs.iter().any(|p| id.starts_with(p.as_str()));
        demo::list().iter().map(|info| info.id).filter(|id| is_asked(id)).collect()
    }

    /// The names of the pairs that are asked for.
    pub fn names(&self) -> Vec<String> {
        let mut names = common::pair_names(&self.data);
        for wanted in self.pairs.iter().filter(|p| !names.iter().any(|name| name.starts_with(p.as_str()))) {
            eprintln!("no pair's name begins with {wanted}");
        }
        names.retain(|name| self.pairs.is_empty() || self.pairs.iter().any(|p| name.starts_with(p.as_str())));
        names
    }
}
