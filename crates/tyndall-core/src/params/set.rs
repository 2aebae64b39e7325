//! A set of parameters that UI, scene file and command line walk without knowing the concrete type.

use super::{ParamError, ParamInfo, TextInfo};

/// Implemented by every struct that [`params!`](crate::params!) declares.
pub trait ParamSet {
    /// One entry per parameter, in the order of declaration.
    fn info(&self) -> &'static [ParamInfo];

    /// Value of parameter `index` of [`ParamSet::info`].
    fn get(&self, index: usize) -> f64;

    /// Sets parameter `index`; the caller has checked the value with [`ParamInfo::check`].
    fn set_unchecked(&mut self, index: usize, value: f64);

    /// One entry per parameter that is text, in the order of declaration.
    fn text_info(&self) -> &'static [TextInfo];

    /// Text `index` of [`ParamSet::text_info`].
    fn text(&self, index: usize) -> &str;

    /// Sets text `index`; the caller has checked it with [`TextInfo::check`].
    fn put_text_unchecked(&mut self, index: usize, text: &str);

    /// Position of a parameter in [`ParamSet::info`].
    ///
    /// # Errors
    /// When no parameter has that name, or the one that has it is a text.
    fn position(&self, name: &str) -> Result<usize, ParamError> {
        if let Some(index) = self.text_position(name) {
            return Err(ParamError::IsText { name: self.text_info()[index].name });
        }
        let found = self.info().iter().position(|info| info.name == name);
        found.ok_or_else(|| ParamError::Unknown { name: name.to_owned() })
    }

    /// Position of a parameter in [`ParamSet::text_info`]; `None` when there is none of that name.
    fn text_position(&self, name: &str) -> Option<usize> {
        self.text_info().iter().position(|info| info.name == name)
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
        if let Some(index) = self.text_position(name) {
            self.put_text_unchecked(index, self.text_info()[index].check(text)?);
            return Ok(());
        }
        let index = self.position(name)?;
        self.set_unchecked(index, self.info()[index].parse(text)?);
        Ok(())
    }
}
