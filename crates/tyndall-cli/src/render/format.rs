//! What kind of file the picture becomes.

use std::path::Path;

use tyndall_io::{Compression, ExrOptions, Precision};

use crate::Failure;

/// Bits of a channel of a PNG file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Bits {
    /// Eight, with dither.
    #[value(name = "8", help = "for screens and the web")]
    Eight,
    /// Sixteen.
    #[value(name = "16", help = "for further work on the developed picture")]
    Sixteen,
}

/// How an EXR file is packed; all are lossless.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum CompressionName {
    /// Deflate row by row; the fastest
    Zips,
    /// Deflate 16 rows at a time; a little smaller
    Zip,
    /// Wavelets; the smallest for noisy pictures
    Piz,
    /// Not at all
    None,
}

/// The options that concern the file.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub struct FormatArguments {
    /// Bits a channel of a PNG file; 8 unless given
    #[arg(long, value_enum)]
    pub bits: Option<Bits>,
    /// EXR with 16-bit floats: half the size, light above 65,504 cd/m2 is clamped (the default)
    #[arg(long, conflicts_with = "float")]
    pub half: bool,
    /// EXR with 32-bit floats: the sun's disc keeps its energy
    #[arg(long)]
    pub float: bool,
    /// How an EXR file is packed; zips unless given
    #[arg(long, value_enum, value_name = "METHOD")]
    pub compression: Option<CompressionName>,
}

/// What the picture becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputFormat {
    /// Developed picture, sRGB.
    Png(Bits),
    /// Developed picture, sRGB, 8 bits, lossy.
    Jpeg,
    /// Light of the scene and depth.
    Exr(Precision, Compression),
    /// Light of the scene as an array of rows, columns and three channels.
    Npy,
}

impl OutputFormat {
    /// Options of the EXR writer; its defaults for other formats.
    pub(crate) fn exr_options(self) -> ExrOptions {
        match self {
            Self::Exr(precision, compression) => ExrOptions { precision, compression, ..ExrOptions::default() },
            Self::Png(_) | Self::Jpeg | Self::Npy => ExrOptions::default(),
        }
    }
}

impl FormatArguments {
    /// The format that the file's ending and the options ask for.
    ///
    /// # Errors
    /// When the ending is unknown, or an option does not concern this format.
    pub fn for_file(self, path: &Path) -> Result<OutputFormat, Failure> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let format = match ending.as_deref() {
            Some("png") => OutputFormat::Png(self.bits.unwrap_or(Bits::Eight)),
            Some("jpg" | "jpeg") => OutputFormat::Jpeg,
            Some("exr") => OutputFormat::Exr(self.precision(), self.exr_compression()),
            Some("npy") => OutputFormat::Npy,
            _ => {
                let sentence = "the file's ending decides its format and must be .png, .exr, .npy, .jpg or .jpeg";
                return Err(Failure::Usage(format!("cannot write {}: {sentence}", path.display())));
            }
        };
        self.refuse_foreign(path, format)?;
        Ok(format)
    }

    /// Refuses options that would be ignored.
    fn refuse_foreign(self, path: &Path, format: OutputFormat) -> Result<(), Failure> {
        let is_exr = matches!(format, OutputFormat::Exr(..));
        let is_png = matches!(format, OutputFormat::Png(_));
        let given = [
            ("--bits", "PNG", self.bits.is_some() && !is_png),
            ("--half", "EXR", self.half && !is_exr),
            ("--float", "EXR", self.float && !is_exr),
            ("--compression", "EXR", self.compression.is_some() && !is_exr),
        ];
        match given.into_iter().find(|(_, _, foreign)| *foreign) {
            Some((option, kind, _)) => {
                let file = path.display();
                Err(Failure::Usage(format!("{option} concerns {kind} files only, and {file} is none")))
            }
            None => Ok(()),
        }
    }

    fn precision(self) -> Precision {
        if self.float { Precision::Float } else { Precision::Half }
    }

    fn exr_compression(self) -> Compression {
        match self.compression {
            None | Some(CompressionName::Zips) => Compression::Zips,
            Some(CompressionName::Zip) => Compression::Zip,
            Some(CompressionName::Piz) => Compression::Piz,
            Some(CompressionName::None) => Compression::None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format(file: &str, arguments: FormatArguments) -> Result<OutputFormat, Failure> {
        arguments.for_file(Path::new(file))
    }

    #[test]
    fn the_ending_decides_the_format() {
        let none = FormatArguments::default();
        for (file, expected) in [
            ("a.png", OutputFormat::Png(Bits::Eight)),
            ("a.b/C.PNG", OutputFormat::Png(Bits::Eight)),
            ("a.jpeg", OutputFormat::Jpeg),
            ("a.jpg", OutputFormat::Jpeg),
            ("a.npy", OutputFormat::Npy),
            ("a.exr", OutputFormat::Exr(Precision::Half, Compression::Zips)),
        ] {
            assert_eq!(format(file, none).unwrap(), expected, "{file}");
        }
    }

    #[test]
    fn other_endings_are_refused_with_those_that_are_known() {
        for file in ["a", "a.tiff", "png", "a.png.", ".png"] {
            let sentence = format(file, FormatArguments::default()).expect_err(file).to_string();
            assert!(sentence.contains(".png, .exr, .npy, .jpg or .jpeg"), "{sentence}");
        }
    }

    #[test]
    fn options_of_another_format_are_refused_rather_than_ignored() {
        let float = FormatArguments { float: true, ..FormatArguments::default() };
        let bits = FormatArguments { bits: Some(Bits::Sixteen), ..FormatArguments::default() };
        let packed = FormatArguments { compression: Some(CompressionName::Piz), ..FormatArguments::default() };
        for (file, arguments, option) in [
            ("a.png", float, "--float"),
            ("a.jpg", bits, "--bits"),
            ("a.exr", bits, "--bits"),
            ("a.png", packed, "--compression"),
        ] {
            let sentence = format(file, arguments).expect_err(file).to_string();
            assert!(sentence.starts_with(option) && sentence.contains(file), "{sentence}");
        }
        assert_eq!(format("a.png", bits).unwrap(), OutputFormat::Png(Bits::Sixteen), "its own option is taken");
    }
}
