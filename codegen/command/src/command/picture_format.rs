//! Chooses the file format of a drawing: SVG, DXF, or PNG in builds with the feature `png`.

use std::path::Path;

use super::Problem;
use crate::arguments::Draw;
use crate::output::Signature;
use crate::report::picture;

/// File format of a drawing.
#[derive(Clone, Copy, Debug)]
pub struct PictureFormat {
    /// Signature of such a file.
    pub signature: Signature,
    /// Printer of such a file.
    pub printer: Printer,
}

/// Printer of a drawing.
#[derive(Clone, Copy, Debug)]
pub enum Printer {
    /// Encodes the text of an SVG. The flag is true if the arguments name a size, which becomes that of the file.
    Picture(fn(&str, bool) -> Result<Vec<u8>, Problem>),
    /// Writes a DXF.
    Dxf,
}

impl PictureFormat {
    /// Returns the format that the arguments request.
    ///
    /// # Errors
    /// The requested format is unknown, differs from the extension of the file, or is a PNG, which this build leaves out.
    pub fn of(arguments: &Draw) -> Result<PictureFormat, Problem> {
        let path = arguments.out.as_deref();
        let named = match path.and_then(Path::extension) {
            None => None,
            Some(extension) => Some(
                FORMATS
                    .iter()
                    .find(|(name, _)| extension.eq_ignore_ascii_case(name))
                    .ok_or_else(|| unknown(path, &format!("`.{}`", extension.display())))?,
            ),
        };
        match (named, arguments.png) {
            (Some(("dxf", _)), false) if arguments.size.is_some() => Err(Problem(format!(
                "error: cannot write `{}`: `--size` is in pixels, and a DXF is at full scale\n  = help: leave out `--size`",
                path.unwrap_or(Path::new("")).display()
            ))),
            (Some(("png", _)) | None, true) => png(),
            (Some((name, _)), true) => Err(Problem(format!(
                "error: cannot write `{}`: `--png` draws a PNG, and the file is named `.{name}`\n  = help: leave out `--png`, or name a file that ends in `.png`",
                path.unwrap_or(Path::new("")).display()
            ))),
            (Some((_, format)), false) => format(),
            (None, false) => svg(),
        }
    }
}

/// Function that returns a file format, or the reason that this build does not have it.
type Available = fn() -> Result<PictureFormat, Problem>;

/// File formats of drawings by the extensions of their files.
const FORMATS: [(&str, Available); 3] = [("svg", svg), ("png", png), ("dxf", dxf)];

/// Returns the error of a file whose extension belongs to no format.
fn unknown(path: Option<&Path>, extension: &str) -> Problem {
    let names: Vec<String> = FORMATS
        .iter()
        .map(|(name, _)| format!("`.{name}`"))
        .collect();
    Problem(format!(
        "error: cannot write `{}`: pictures cannot be written as {extension}\n  = help: name a file with one of the endings {}",
        path.unwrap_or(Path::new("")).display(),
        names.join(", ")
    ))
}

fn svg() -> Result<PictureFormat, Problem> {
    Ok(SVG)
}

const SVG: PictureFormat = PictureFormat {
    signature: picture::SIGNATURE,
    printer: Printer::Picture(|svg, _| Ok(picture::signed(svg).into_bytes())),
};

fn dxf() -> Result<PictureFormat, Problem> {
    Ok(PictureFormat {
        signature: crate::report::dxf::SIGNATURE,
        printer: Printer::Dxf,
    })
}

#[cfg(feature = "png")]
fn png() -> Result<PictureFormat, Problem> {
    use crate::report::raster;
    Ok(PictureFormat {
        signature: raster::SIGNATURE,
        printer: Printer::Picture(|svg, has_size| {
            let factor = if has_size { 1.0 } else { raster::FINE };
            raster::raster(svg, factor)
                .map_err(|text| Problem(format!("error: cannot make a PNG: {text}")))
        }),
    })
}

#[cfg(not(feature = "png"))]
fn png() -> Result<PictureFormat, Problem> {
    Err(super::left_out::refusal("png", "draws pictures in pixels"))
}
