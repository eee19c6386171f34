//! Which options does `catoptra explain` have?

use std::path::PathBuf;

use clap::Args;

use super::JobArgs;

#[derive(Args)]
pub(crate) struct ExplainArgs {
    /// Scene file (.kdl) or model file (.obj, .glb and so on), or - for standard input
    pub(crate) scene: PathBuf,
    #[command(flatten)]
    pub(crate) job: JobArgs,
    /// Answer with a JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
