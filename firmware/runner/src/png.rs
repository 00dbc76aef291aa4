//! Pictures as PNG files.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Gray4, Gray8, Rgb565, Rgb888};
use embedded_graphics::prelude::{GrayColor, RgbColor};

use crate::board::{Board, Output};
use crate::picture::Size;

/// The file of a board's picture: `file` itself if there is only one board.
pub(crate) fn file_for(file: &Path, board: &Board, boards: usize) -> PathBuf {
    if boards == 1 {
        return file.to_path_buf();
    }
    let mut name = file.file_stem().unwrap_or_default().to_os_string();
    name.push("-");
    name.push(board.name);
    if let Some(extension) = file.extension() {
        name.push(".");
        name.push(extension);
    }
    file.with_file_name(name)
}

/// Writes a picture from bytes as the emulator writes them. Of several frames, it writes the panel after the
/// last one.
pub(crate) fn write(file: &Path, size: Size, output: Output, bytes: &[u8]) -> Result<()> {
    let size = match output {
        Output::Frames(panel) => panel,
        Output::File | Output::Panel(_) => size,
    };
    let bytes = bytes.chunks(size.pixels() * output.pixel_bytes()).next_back().unwrap_or_default();
    let (color_type, data): (_, Vec<u8>) = match output {
        Output::File | Output::Frames(_) => {
            (png::ColorType::Rgb, bytes.as_chunks::<2>().0.iter().flat_map(rgb888).collect())
        }
        Output::Panel(_) => (
            png::ColorType::Grayscale,
            bytes.iter().map(|gray| Gray8::from(Gray4::new(*gray)).luma()).collect(),
        ),
    };
    let writer = BufWriter::new(File::create(file).with_context(|| file.display().to_string())?);
    let mut encoder = png::Encoder::new(writer, size.width.into(), size.height.into());
    encoder.set_color(color_type);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&data)?;
    Ok(())
}

fn rgb888(bytes: &[u8; 2]) -> [u8; 3] {
    let color = Rgb888::from(Rgb565::from(RawU16::new(u16::from_le_bytes(*bytes))));
    [color.r(), color.g(), color.b()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::BOARDS;

    #[test]
    fn several_boards_have_files_of_their_own() {
        let board = BOARDS.first().unwrap();
        assert_eq!(file_for(Path::new("a/b.png"), board, 1), Path::new("a/b.png"));
        assert_eq!(file_for(Path::new("a/b.png"), board, 2), Path::new("a/b-lm3s6965evb.png"));
    }

    #[test]
    fn full_light_is_white() {
        assert_eq!(rgb888(&[0xFF, 0xFF]), [255; 3]);
        assert_eq!(rgb888(&[0x00, 0xF8]), [255, 0, 0]);
    }
}
