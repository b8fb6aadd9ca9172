//! `conemap flow`.
pub fn run(_options: &crate::arguments::FlowArguments) -> Result<(), String> {
    Ok(())
}
