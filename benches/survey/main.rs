//! Tables of many maps: `cargo xtask survey TABLE [--pairs NAME,NAME] [--seeds N] [--jobs N] [--time-limit SECONDS]`.
//!
//! A table maps the pairs of the data folder as they are, or as users would have given them: clicked inside faces, remeshed,
//! with few landmarks. Each line has the figures of one map, with its processor time; the last lines sum up. A map that fails
//! or takes longer than the limit has a line that says so.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a survey prints its tables")]
#![allow(clippy::expect_used, reason = "without its data a survey ends")]

#[path = "../../tests/common/bodies/mod.rs"]
mod bodies;
#[path = "../../tests/common/clicked.rs"]
mod clicked;
#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "../../tests/common/cutting.rs"]
mod cutting;
#[path = "../../tests/common/ends.rs"]
mod ends;
#[path = "../../tests/common/hostile_geometry.rs"]
mod hostile_geometry;
#[path = "../../tests/common/judged_job.rs"]
mod judged_job;
#[path = "../../tests/common/other_triangles.rs"]
mod other_triangles;
#[path = "../../tests/common/punching.rs"]
mod punching;
#[path = "../../tests/common/quads.rs"]
mod quads;
#[path = "../../tests/common/rough_meshes.rs"]
mod rough_meshes;
#[path = "../../tests/common/shrec07.rs"]
mod shrec07;

mod arguments;
mod borders;
mod case;
mod classes;
mod clicks;
mod cones;
mod determinism;
mod few;
mod fit;
mod fit_faults;
mod folded;
mod holes;
mod hostile;
mod job_files;
mod made;
mod matched;
mod memory;
mod morph;
mod orders;
mod pairs;
mod process_memory;
mod remesh;
mod remeshed;
mod repaired;
mod silence;
mod soak;
mod soft;
mod stages;
mod structures;
mod table;
mod torture;
mod verify;
mod watch;
mod wrap;

use arguments::Arguments;

/// A table: its name, a line about it for the list of tables, and the function that prints it.
struct Survey {
    name: &'static str,
    about: &'static str,
    run: fn(&Arguments),
}

const SURVEYS: &[Survey] = &[
    Survey { name: "pairs", about: "all pairs as they are", run: pairs::as_they_are },
    Survey { name: "exchanged", about: "all pairs with source and target exchanged", run: pairs::exchanged },
    Survey {
        name: "clicks",
        about: "each landmark at a random point of a random face beside it",
        run: clicks::random,
    },
    Survey {
        name: "few",
        about: "five and eight of the landmarks, drawn at random, compared with all; --seed N, --seeds N, --landmarks N",
        run: few::drawn,
    },
    Survey {
        name: "beside",
        about: "landmarks inside faces, given as such or as vertices of a refined mesh, beside edges and on edges",
        run: clicks::same_points,
    },
    Survey {
        name: "classes",
        about: "the class chosen, compared with all classes a twist away (--depth 2: and two twists away)",
        run: classes::exhaustive,
    },
    Survey {
        name: "orders",
        about: "the class chosen with landmarks in other orders and clicked beside their vertices; --seeds N, --variants order,clicks; --depth 2: all judged",
        run: orders::table,
    },
    Survey {
        name: "remesh",
        about: "every mesh remeshed to half, once and twice its faces; --pairs FOLDER/NAME,...",
        run: remesh::data_meshes,
    },
    Survey {
        name: "remeshed",
        about: "the target in other triangles, landmarks in faces; --variants half,isotropic,...",
        run: remeshed::targets,
    },
    Survey {
        name: "truth",
        about: "poses with a known truth, the same connectivity or remeshed, 33, 12 and 6 landmarks; --pairs horse-horse,cat-cat",
        run: remeshed::truth,
    },
    Survey {
        name: "folded",
        about: "bodies onto remeshed copies folded at random, with a known truth, 12 and 6 landmarks; --seeds N, --landmarks N, --pairs FOLDER/NAME,...",
        run: folded::bodies,
    },
    Survey {
        name: "holes",
        about: "poses with holes punched and capped, compared with the closed pairs; --variants 'foot 0.5','limb 10',... --cap-weight 1 counts caps like skin",
        run: holes::punched,
    },
    Survey {
        name: "holes-anywhere",
        about: "poses with one to three holes of 0.5 to 5 % of the area at random places; --seed S --seeds N",
        run: holes::anywhere,
    },
    Survey {
        name: "borders",
        about: "both meshes cut at the neck: distance from rim to rim, errors near the rims, compared with the closed pair; --variants head,'neck and limb',... --toll 0.5",
        run: borders::cut,
    },
    Survey {
        name: "wrap",
        about: "bases with quads laid onto scans with and without holes: distances, flipped triangles; --variants clean,'at 12',...",
        run: wrap::bases,
    },
    Survey {
        name: "repaired",
        about: "files with faults, after the repairs that are offered, onto a partner or a remeshed, bent copy; --pairs NAME,...",
        run: repaired::files,
    },
    Survey {
        name: "bodies",
        about: "writes bodies of many kinds, made by the program, into the folder --data, from which the tables of pairs read; --seed S",
        run: made::write,
    },
    Survey { name: "demos", about: "each demo with its landmarks; --pairs NAME,...", run: pairs::demos },
    Survey {
        name: "cones",
        about: "each demo with cones of the base domain and with equal ones, by the thesis' method; --pairs NAME,...",
        run: cones::table,
    },
    Survey {
        name: "structures",
        about: "each demo's flows by each discrete conformal structure; --pairs NAME,...",
        run: structures::table,
    },
    Survey {
        name: "morph",
        about: "shapes half-way between each demo's meshes, on straight lines and bent; --pairs NAME,...",
        run: morph::table,
    },
    Survey {
        name: "stages",
        about: "the share of each stage, measured and told; --landmarks 12 for few landmarks",
        run: stages::shares,
    },
    Survey {
        name: "verify",
        about: "the map files of all pairs, proved anew by conemap-verify",
        run: verify::both_certificates,
    },
    Survey {
        name: "fit",
        about: "landmarks that do not fit: false alarms on correct pairs, and the share of faults that are named",
        run: fit::table,
    },
    Survey {
        name: "hostile",
        about: "shapes and landmarks made to break the program: outcome, seconds, memory, silence; --pairs sphere-perm,cube",
        run: hostile::table,
    },
    Survey {
        name: "silence",
        about: "how long a run asks its monitor nothing, by stage: --pairs ball-6,cat-lion,single/horse97k.off",
        run: silence::table,
    },
    Survey {
        name: "determinism",
        about: "the same files twice, with source and target exchanged, with the landmarks in another order",
        run: determinism::table,
    },
    Survey {
        name: "soak",
        about: "what one process holds in memory over 200 maps of the demos (--seeds N: over N)",
        run: soak::table,
    },
    Survey {
        name: "torture",
        about: "generated hostile geometry for --minutes N, from --seed S; --pairs slivers,hubs for some kinds",
        run: torture::table,
    },
    Survey {
        name: "torture-case",
        about: "cases of torture in this process: --pairs slivers-17,hubs-3",
        run: torture::cases,
    },
    Survey {
        name: "memory",
        about: "the largest memory of whole jobs by faces: balls, pairs by name, meshes by path (--pairs)",
        run: memory::table,
    },
    Survey {
        name: "memory-case",
        about: "jobs of memory in this process, for that table",
        run: memory::case,
    },
    Survey {
        name: "hostile-case",
        about: "a case of hostile in this process, for that table",
        run: hostile::case,
    },
    Survey {
        name: "soft",
        about: "landmarks clicked beside their places, held there and soft, on pairs with a known truth; --pairs NAME,... --seeds N",
        run: soft::table,
    },
    Survey {
        name: "match",
        about: "pairs matched without a landmark, both directions: known landmarks, verdict; --seeds N: varied targets, --variants full,answered: whole maps, questions answered, --landmarks N: given, --depth 2: all candidates",
        run: matched::table,
    },
];

/// The tables that need no data folder, since they are of meshes that the project makes itself.
const NEED_NO_DATA: [&str; 6] = ["bodies", "cones", "demos", "soak", "torture", "torture-case"];

fn main() {
    let arguments = Arguments::read();
    match SURVEYS.iter().find(|survey| survey.name == arguments.table) {
        Some(survey) => {
            if !NEED_NO_DATA.contains(&survey.name) && arguments.data == common::data_path() {
                common::data_folder("the survey").expect("the data folder");
            }
            (survey.run)(&arguments);
        }
        None => {
            eprintln!(
                "cargo xtask survey TABLE [--data FOLDER] [--pairs NAME,NAME] [--seeds N] [--jobs N] [--time-limit SECONDS]"
            );
            SURVEYS.iter().for_each(|survey| eprintln!("  {:16}{}", survey.name, survey.about));
        }
    }
}
