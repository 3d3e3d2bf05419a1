//! The block that a command is given, and its parameters.

use clap::Args;
use clap::builder::PossibleValuesParser;
use tilewright_rtl::catalog::{self, CatalogError, ENTRIES, Entry, Values};

/// A block of the catalogue with parameters.
#[derive(Args)]
pub struct BlockArguments {
    /// A block's name
    #[arg(value_name = "BLOCK", value_parser = PossibleValuesParser::new(ENTRIES.iter().map(|entry| entry.name)))]
    block: String,
    /// A parameter's value, as often as needed; `tilewright list` has their names and ranges
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    settings: Vec<(String, u64)>,
}

impl BlockArguments {
    /// The block and the values of its parameters.
    ///
    /// # Errors
    /// There is no such parameter, or a value is out of its range.
    pub fn find(&self) -> Result<(&'static Entry, Values), CatalogError> {
        let entry = catalog::find(&self.block).expect("the command line admits only names of the catalogue");
        let values = entry.values(self.settings.iter().map(|(name, value)| (name.as_str(), *value)))?;
        Ok((entry, values))
    }
}

fn setting(text: &str) -> Result<(String, u64), &'static str> {
    let (name, value) = text.split_once('=').ok_or("write it as NAME=VALUE, such as width=16")?;
    let value = value.parse().map_err(|_| "the value has to be a whole number, such as width=16")?;
    Ok((name.to_owned(), value))
}
