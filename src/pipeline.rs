//! Options, order of the stages, report.
