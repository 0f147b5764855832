//! GPU buffers that are written anew each frame.

/// A buffer that grows when it must and is otherwise reused.
pub(super) struct Reused {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: Option<wgpu::Buffer>,
    used: u64,
}

impl Reused {
    pub(super) fn new(label: &'static str, usage: wgpu::BufferUsages) -> Self {
        Self { label, usage: usage | wgpu::BufferUsages::COPY_DST, buffer: None, used: 0 }
    }

    /// Replaces the content. What no buffer of this device can hold is not taken: the buffer is then empty.
    pub(super) fn write(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, bytes: &[u8]) {
        let needed = bytes.len() as u64;
        let limit = device.limits().max_buffer_size;
        if needed == 0 || needed > limit {
            self.used = 0;
            return;
        }
        let fits = self.buffer.as_ref().is_some_and(|b| b.size() >= needed);
        if !fits {
            self.free();
            self.buffer = Some(device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: needed.next_power_of_two().max(4096).min(limit),
                usage: self.usage,
                mapped_at_creation: false,
            }));
        }
        if let Some(buffer) = &self.buffer {
            queue.write_buffer(buffer, 0, bytes);
        }
        self.used = needed;
    }

    /// The content, or `None` when there is none.
    pub(super) fn slice(&self) -> Option<wgpu::BufferSlice<'_>> {
        match &self.buffer {
            Some(buffer) if self.used > 0 => Some(buffer.slice(..self.used)),
            _ => None,
        }
    }

    fn free(&mut self) {
        if let Some(buffer) = self.buffer.take() {
            buffer.destroy();
        }
    }
}

/// At once, as `Target`.
impl Drop for Reused {
    fn drop(&mut self) {
        self.free();
    }
}
