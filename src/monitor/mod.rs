//! Progress, cancellation and the wish to finish now: the only upward call of the core.

mod beside;
mod or_stop;
mod portion;
mod preview;
mod progress;
mod pulse;
mod receiver;
mod rising;
mod stage;

pub use beside::if_time;
pub use or_stop::{OrStop, unless_stopped};
pub use portion::Portion;
pub use preview::MapPreview;
pub use progress::{PlannedStage, Progress};
pub use pulse::Pulse;
pub use receiver::{Cancelled, Monitor, Silent, Step};
pub use rising::Rising;
pub use stage::Stage;
