//! A set of parameters that UI, scene file and command line walk without knowing the concrete type.

use super::{ParamError, ParamInfo};

/// Implemented by every struct that [`params!`](crate::params!) declares.
pub trait ParamSet {
    /// One entry per parameter, in the order of declaration.
    fn info(&self) -> &'static [ParamInfo];

    /// Value of parameter `index` of [`ParamSet::info`].
    fn get(&self, index: usize) -> f64;

    /// Sets parameter `index`; the caller has checked the value with [`ParamInfo::check`].
    fn set_unchecked(&mut self, index: usize, value: f64);

    /// Position of a parameter in [`ParamSet::info`].
    ///
    /// # Errors
    /// When no parameter has that name.
    fn position(&self, name: &str) -> Result<usize, ParamError> {
        let found = self.info().iter().position(|info| info.name == name);
        found.ok_or_else(|| ParamError::Unknown { name: name.to_owned() })
    }

    /// Sets a parameter by name.
    ///
    /// # Errors
    /// When no parameter has that name or the value is not allowed.
    fn set(&mut self, name: &str, value: f64) -> Result<(), ParamError> {
        let index = self.position(name)?;
        self.set_unchecked(index, self.info()[index].check(value)?);
        Ok(())
    }

    /// Sets a parameter by name from text as users write it.
    ///
    /// # Errors
    /// When no parameter has that name or the text is not an allowed value.
    fn set_text(&mut self, name: &str, text: &str) -> Result<(), ParamError> {
        let index = self.position(name)?;
        self.set_unchecked(index, self.info()[index].parse(text)?);
        Ok(())
    }
}
