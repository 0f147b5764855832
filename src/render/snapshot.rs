//! A picture read back from the GPU, without waiting for it.

use super::target::Target;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

const PENDING: u8 = 0;
const MAPPED: u8 = 1;
const LOST: u8 = 2;

/// A picture on its way back: ask [`Snapshot::take`] in each frame.
#[derive(Debug)]
pub struct Snapshot {
    buffer: wgpu::Buffer,
    size: [u32; 2],
    /// Bytes from one row to the next.
    row: u32,
    state: Arc<AtomicU8>,
}

/// A picture in memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixels {
    /// Width and height.
    pub size: [u32; 2],
    /// Rows from the top, four bytes for each pixel: red, green, blue, gamma-encoded and not multiplied by alpha, and alpha.
    pub rgba: Vec<u8>,
}

/// The GPU gave no picture back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lost;

impl Snapshot {
    /// Copies a target's picture and submits what `encoder` holds before.
    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        mut encoder: wgpu::CommandEncoder,
        target: &Target,
    ) -> Self {
        let size = target.size;
        let row = (4 * size[0]).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("snapshot"),
            size: u64::from(row) * u64::from(size[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let texture = target.resolved.texture();
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            texture.size(),
        );
        queue.submit([encoder.finish()]);
        let state = Arc::new(AtomicU8::new(PENDING));
        let told = Arc::clone(&state);
        buffer.slice(..).map_async(wgpu::MapMode::Read, move |result| {
            told.store(if result.is_ok() { MAPPED } else { LOST }, Ordering::Release);
        });
        Self { buffer, size, row, state }
    }

    /// The picture, once it is there; none before. After that there is nothing left to ask for.
    ///
    /// # Errors
    /// When the device was lost on the way.
    pub fn take(&self, device: &wgpu::Device) -> Option<Result<Pixels, Lost>> {
        // In a browser this waits for nothing: answers come between frames.
        if device.poll(wgpu::PollType::Poll).is_err() {
            return Some(Err(Lost));
        }
        match self.state.load(Ordering::Acquire) {
            PENDING => None,
            MAPPED => Some(self.read()),
            _ => Some(Err(Lost)),
        }
    }

    fn read(&self) -> Result<Pixels, Lost> {
        let bytes = self.buffer.slice(..).get_mapped_range().map_err(|_| Lost)?;
        let wide = 4 * self.size[0] as usize;
        let rows = bytes.chunks_exact(self.row as usize).map(|row| &row[..wide]);
        let rgba = rows.flat_map(|row| row.chunks_exact(4)).flat_map(straight).collect();
        Ok(Pixels { size: self.size, rgba })
    }
}

/// At once, as `Target`.
impl Drop for Snapshot {
    fn drop(&mut self) {
        self.buffer.destroy();
    }
}

/// A pixel whose colour is no longer multiplied by its alpha.
fn straight(pixel: &[u8]) -> [u8; 4] {
    let &[red, green, blue, alpha] = pixel else { return [0; 4] };
    let whole = |part: u8| match alpha {
        0 => 0,
        _ => ((u32::from(part) * 255 + u32::from(alpha) / 2) / u32::from(alpha)).min(255) as u8,
    };
    [whole(red), whole(green), whole(blue), alpha]
}

#[cfg(test)]
mod tests {
    use super::straight;

    #[test]
    fn colours_are_divided_by_alpha() {
        assert_eq!(straight(&[10, 20, 30, 255]), [10, 20, 30, 255]);
        assert_eq!(straight(&[64, 0, 128, 128]), [128, 0, 255, 128]);
        assert_eq!(straight(&[0, 0, 0, 0]), [0; 4]);
        assert_eq!(straight(&[200, 1, 0, 100]), [255, 3, 0, 100]);
    }
}
