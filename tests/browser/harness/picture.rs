//! Pictures of the page and what can be said about them.

use std::collections::HashSet;
use std::io::Cursor;

/// A picture, rows from the top, three bytes for each pixel.
pub struct Picture {
    pub width: usize,
    pub height: usize,
    rgb: Vec<u8>,
}

/// A part of a picture as fractions of it: left, top, right, bottom.
#[derive(Clone, Copy, Debug)]
pub struct Area(pub f64, pub f64, pub f64, pub f64);

impl Area {
    /// The whole picture.
    pub const ALL: Self = Self(0.0, 0.0, 1.0, 1.0);
}

impl Picture {
    /// Reads a PNG file.
    pub fn decode(png: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(Cursor::new(png));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a PNG that fits in memory")];
        let info = reader.next_frame(&mut bytes).expect("a whole PNG");
        let channels = info.color_type.samples();
        let (width, height) = (info.width as usize, info.height as usize);
        let rgb = bytes[..info.buffer_size()]
            .chunks_exact(channels)
            .flat_map(|pixel| [pixel[0], pixel[channels / 2], pixel[channels.min(3) - 1]])
            .collect();
        Self { width, height, rgb }
    }

    fn pixels(&self, area: Area) -> impl Iterator<Item = [u8; 3]> {
        let index = |fraction: f64, length: usize| ((fraction * length as f64) as usize).min(length);
        let rows = index(area.1, self.height)..index(area.3, self.height);
        let columns = index(area.0, self.width)..index(area.2, self.width);
        rows.flat_map(move |y| columns.clone().map(move |x| 3 * (y * self.width + x)))
            .map(|i| [self.rgb[i], self.rgb[i + 1], self.rgb[i + 2]])
    }

    /// How many different colours there are: one in a blank area.
    pub fn colours(&self, area: Area) -> usize {
        self.pixels(area).collect::<HashSet<_>>().len()
    }

    /// Mean of all channels, 0 black to 255 white.
    pub fn brightness(&self, area: Area) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for pixel in self.pixels(area) {
            sum += pixel.iter().map(|channel| f64::from(*channel)).sum::<f64>() / 3.0;
            count += 1.0;
        }
        sum / count
    }

    /// How many pixels differ visibly from `other`, a picture of the same size.
    pub fn changed(&self, other: &Self, area: Area) -> usize {
        assert_eq!((self.width, self.height), (other.width, other.height));
        self.pixels(area)
            .zip(other.pixels(area))
            .filter(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 24))
            .count()
    }
}
