//! A part of a stage that reports its own progress from 0 to 1.

use super::{Cancelled, MapPreview, Monitor, Step};

/// The monitor of a part of a stage: it passes the part's fractions on as fractions of the stage. They never fall, also where
/// nested parts each begin at 0.
pub struct Portion<'a> {
    monitor: &'a mut dyn Monitor,
    from: f64,
    to: f64,
    /// The largest fraction of the part so far.
    done: f64,
    previews: Previews,
}

/// The treatment of the previews of a part.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Previews {
    Shown,
    Hidden,
}

impl<'a> Portion<'a> {
    /// The part of the present stage of `monitor` that leads from the share `from` to the share `to` (0 to 1).
    pub fn new(monitor: &'a mut dyn Monitor, from: f64, to: f64) -> Self {
        Self { monitor, from, to, done: 0.0, previews: Previews::Shown }
    }

    /// The same, but that its previews are not passed on: of maps that may be worse than one that was seen.
    #[must_use]
    pub fn unseen(self) -> Self {
        Self { previews: Previews::Hidden, ..self }
    }
}

impl Monitor for Portion<'_> {
    fn wrapped(&self) -> Option<&dyn Monitor> {
        Some(self.monitor)
    }

    fn wrapped_mut(&mut self) -> Option<&mut dyn Monitor> {
        Some(self.monitor)
    }

    fn preview(&mut self, preview: &dyn MapPreview) {
        if self.previews == Previews::Shown {
            self.monitor.preview(preview);
        }
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.done = self.done.max(step.fraction.min(1.0));
        let fraction = self.from + (self.to - self.from) * self.done;
        self.monitor.step(Step { fraction, ..step })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_side::MeshSide;
    use glam::DVec3;

    /// Remembers fractions.
    #[derive(Default)]
    struct Recorder(Vec<f64>);

    impl Monitor for Recorder {
        fn step(&mut self, step: Step) -> Result<(), Cancelled> {
            self.0.push(step.fraction);
            Ok(())
        }
    }

    /// Counts previews, and asks none for images.
    #[derive(Default)]
    struct Counter(usize);

    impl Monitor for Counter {
        fn preview(&mut self, _preview: &dyn MapPreview) {
            self.0 += 1;
        }

        fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
            Ok(())
        }
    }

    /// Must not be asked.
    struct Unasked;

    impl MapPreview for Unasked {
        fn images(&self, _of: MeshSide) -> Option<Vec<DVec3>> {
            panic!("nobody wanted images")
        }
    }

    #[test]
    fn previews_pass_through_portions_but_for_those_that_are_not_to_be_seen() {
        let mut counter = Counter::default();
        Portion::new(&mut Portion::new(&mut counter, 0.0, 0.5), 0.0, 0.1).preview(&Unasked);
        assert_eq!(counter.0, 1);
        let mut unseen = Portion::new(&mut counter, 0.5, 1.0).unseen();
        Portion::new(&mut unseen, 0.0, 1.0).preview(&Unasked);
        assert_eq!(counter.0, 1);
        Recorder::default().preview(&Unasked);
    }

    #[test]
    fn portions_of_portions_nest() {
        let mut recorder = Recorder::default();
        let mut outer = Portion::new(&mut recorder, 0.5, 1.0);
        let mut inner = Portion::new(&mut outer, 0.0, 0.5);
        for fraction in [0.0, 0.5, 0.2, 1.0, 9.0] {
            inner.step(Step { fraction, residual: None }).expect("nobody stops");
        }
        assert_eq!(recorder.0, [0.5, 0.625, 0.625, 0.75, 0.75]);
    }
}
