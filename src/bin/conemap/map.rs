//! `conemap map`.
pub fn run(_options: &crate::arguments::MapArguments) -> Result<(), String> {
    Ok(())
}
