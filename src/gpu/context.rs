//! The device that work outside a window runs on.

/// Why there is no device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// Neither a GPU nor a software renderer.
    #[error("no graphics adapter: install a Vulkan driver, such as Mesa's software renderer (mesa-vulkan-drivers)")]
    NoAdapter(#[source] wgpu::RequestAdapterError),
    /// The adapter has no storage buffers, or less than WebGPU asks for.
    #[error("the graphics adapter `{adapter}` is too limited for the preview")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What it refused.
        #[source]
        source: wgpu::RequestDeviceError,
    },
}

/// A device and its queue, without a window.
#[derive(Clone, Debug)]
pub struct Context {
    /// What makes textures, buffers and pipelines.
    pub device: wgpu::Device,
    /// Where work is handed in.
    pub queue: wgpu::Queue,
    /// The adapter's name and driver, for people.
    pub adapter: String,
}

impl Context {
    /// The best adapter there is: a GPU, or else a software renderer.
    ///
    /// # Errors
    ///
    /// [`GpuError`] where there is none, or none that will do.
    pub fn new() -> Result<Self, GpuError> {
        pollster::block_on(Self::request())
    }

    async fn request() -> Result<Self, GpuError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = instance.request_adapter(&options).await.map_err(GpuError::NoAdapter)?;
        let info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&device_descriptor(&adapter))
            .await
            .map_err(|source| GpuError::NoDevice { adapter: info.name.clone(), source })?;
        Ok(Self { device, queue, adapter: format!("{} ({:?})", info.name, info.backend) })
    }
}

/// What the preview needs of a device: WebGPU's default limits, and textures as large as the adapter allows.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("softbox"),
        required_limits: wgpu::Limits::default().using_resolution(adapter.limits()),
        ..Default::default()
    }
}
